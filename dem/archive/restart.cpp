#include "dem/archive/restart.hpp"

#include <fmt/core.h>

#include <numeric>
#include <stdexcept>

#include "dem/archive/restart_checks.hpp"
#include "dem/archive/restart_layout.hpp"
#include "dem/archive/sealed_file.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

const FileKind restart_kind{"restart", 2};

void set_version(const hdf5::Group& group, std::int32_t major, std::int32_t minor) {
  const std::array<std::int32_t, 2> version{major, minor};
  group.set_numbers("version", hdf5::Number::i32, {2}, version.data());
}

/// The group h5md of H5MD 1.1 (https://nongnu.org/h5md): version, author, creator, the module of units.
void write_h5md(const hdf5::Group& root) {
  const hdf5::Group h5md = root.create("h5md");
  set_version(h5md, 1, 1);
  h5md.create("author").set_text("name", "not told");  // H5MD wants one
  const hdf5::Group creator = h5md.create("creator");
  creator.set_text("name", "soilbin");
  creator.set_text("version", SOILBIN_VERSION);
  const hdf5::Group units = h5md.create("modules").create("units");
  set_version(units, 1, 0);
  units.set_free_text("system", "SI");
}

/// The group box of a group of particles.
void write_box(const hdf5::Group& particles, const Domain& domain) {
  const hdf5::Group box = particles.create("box");
  const std::int32_t dimension = 3;
  box.set_numbers("dimension", hdf5::Number::i32, {}, &dimension);
  std::vector<std::string> boundary;
  for (const bool periodic : domain.periodic) boundary.emplace_back(periodic ? "periodic" : "none");
  box.set_texts("boundary", boundary);
  const Vec3 edges = domain.upper - domain.lower;
  box.write("edges", hdf5::Number::f64, {3}, &edges.x);
  box.set_free_text("unit", "m", "edges");
}

using SharedMesh = std::shared_ptr<const TriangleMesh>;

// Meshes: each once, whoever shares it.

std::vector<SharedMesh> meshes_of(const std::vector<Body>& bodies) {
  std::vector<SharedMesh> all;
  for (const Body& body : bodies)
    for (const Surface& surface : body.surfaces)
      if (const auto* shape = std::get_if<MeshSurface>(&surface.shape))
        if (std::find(all.begin(), all.end(), shape->mesh) == all.end()) all.push_back(shape->mesh);
  return all;
}

void save_meshes(const Saver& a, const std::vector<SharedMesh>& meshes) {
  a.length("count", meshes);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const Saver one = a.inner(std::to_string(k));
    one.text("name", meshes[k]->name());
    one.value("closed", meshes[k]->closed());
    one.length("vertices_count", meshes[k]->vertices(), "vertices");
    one.length("triangles_count", meshes[k]->triangles(), "triangles");
    one.column("vertices", meshes[k]->vertices(), itself, "m");
    one.column("triangles", meshes[k]->triangles(), itself);
  }
}

std::vector<SharedMesh> load_meshes(const Loader& a) {
  std::vector<SharedMesh> meshes;
  a.length("count", meshes);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const Loader one = a.inner(std::to_string(k));
    MeshOptions options;
    options.as_given = true;  // it was welded or mended: its vertices stay what they are
    one.text("name", options.name);
    one.value("closed", options.closed);
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Corners> triangles;
    one.length("vertices_count", vertices, "vertices");
    one.length("triangles_count", triangles, "triangles");
    one.column("vertices", vertices, itself);
    one.column("triangles", triangles, itself);
    meshes[k] = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles), options);
  }
  return meshes;
}

// Bodies.

FlatSurface flat(const Surface& surface, const std::vector<SharedMesh>& meshes) {
  FlatSurface out;
  out.material = surface.material;
  if (const auto* plane = std::get_if<Plane>(&surface.shape)) {
    out.plane = *plane;
  } else {
    const SharedMesh& mesh = std::get<MeshSurface>(surface.shape).mesh;
    out.mesh = static_cast<std::int32_t>(std::find(meshes.begin(), meshes.end(), mesh) - meshes.begin());
  }
  return out;
}

Surface round(const FlatSurface& surface, const std::vector<SharedMesh>& meshes, const std::string& place) {
  if (surface.mesh < 0) return {surface.plane, surface.material};
  if (static_cast<std::size_t>(surface.mesh) >= meshes.size())
    throw InputError({place, 0, 0}, fmt::format("there is no mesh {}", surface.mesh), "",
                     "the file is of another program");
  return {MeshSurface{meshes[static_cast<std::size_t>(surface.mesh)], nullptr}, surface.material};
}

void save_bodies(const Saver& a, const std::vector<Body>& bodies, const std::vector<SharedMesh>& meshes) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Saver one = a.inner(std::to_string(k));
    describe_body(one, bodies[k]);
    std::vector<FlatSurface> surfaces;
    for (const Surface& surface : bodies[k].surfaces) surfaces.push_back(flat(surface, meshes));
    describe_flat(one.inner("surfaces"), surfaces);
  }
}

void load_bodies(const Loader& a, std::vector<Body>& bodies, const std::vector<SharedMesh>& meshes) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Loader one = a.inner(std::to_string(k));
    describe_body(one, bodies[k]);
    std::vector<FlatSurface> surfaces;
    describe_flat(one.inner("surfaces"), surfaces);
    for (const FlatSurface& surface : surfaces)
      bodies[k].surfaces.push_back(round(surface, meshes, one.group().place()));
  }
}

// Contacts with surfaces.

FlatSurfaces flat(const std::vector<SurfaceContacts>& slabs) {
  FlatSurfaces out{{0}, {0}, {}, {}};
  for (const SurfaceContacts& slab : slabs) {
    out.near.insert(out.near.end(), slab.near.begin(), slab.near.end());
    out.made.insert(out.made.end(), slab.made.begin(), slab.made.end());
    out.near_begin.push_back(static_cast<std::uint32_t>(out.near.size()));
    out.made_begin.push_back(static_cast<std::uint32_t>(out.made.size()));
  }
  return out;
}

std::vector<SurfaceContacts> by_slab(const FlatSurfaces& flat, const std::string& place) {
  const auto divides = [&](const std::vector<std::uint32_t>& begins, std::size_t end) {
    return begins.size() == flat.near_begin.size() && !begins.empty() && begins.front() == 0 && begins.back() == end &&
           std::is_sorted(begins.begin(), begins.end());
  };
  if (!divides(flat.near_begin, flat.near.size()) || !divides(flat.made_begin, flat.made.size()))
    throw InputError({place, 0, 0}, "its slabs contradict the rest", "", "the file is of another program");
  std::vector<SurfaceContacts> slabs(flat.near_begin.size() - 1);
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    slabs[k].near.assign(flat.near.begin() + flat.near_begin[k], flat.near.begin() + flat.near_begin[k + 1]);
    slabs[k].made.assign(flat.made.begin() + flat.made_begin[k], flat.made.begin() + flat.made_begin[k + 1]);
  }
  return slabs;
}

// Notes: short texts are attributes; what doesn't fit into one, or isn't a text, is a dataset of bytes.

void save_notes(const hdf5::Group& to, const Notes& notes) {
  constexpr std::size_t longest = 32 << 10;  // an attribute has at most 64 KiB
  for (const auto& [name, text] : notes)
    if (text.size() <= longest && text.find('\0') == std::string::npos)
      to.set_text(name, text);
    else
      to.write(name, hdf5::Number::u8, {text.size()}, text.data());
}

Notes load_notes(const hdf5::Group& from) {
  Notes notes;
  for (const std::string& name : from.text_names()) notes[name] = from.get_text(name);
  for (const std::string& name : from.names()) {
    const hdf5::Shape shape = from.shape(name);
    std::string& text = notes[name];
    if (shape.size() != 1)
      throw InputError({from.place(name), 0, 0}, "is not a text", "", "the file is of another program");
    text.resize(shape[0]);
    from.read(name, hdf5::Number::u8, {text.size()}, text.data());
  }
  return notes;
}

// All of it.

void save(const hdf5::Group& root, const Setup& setup, const State& state, const Notes& notes) {
  write_h5md(root);
  const Saver particles = Saver(root.create("particles")).inner("grains");
  write_box(particles.group(), setup.domain);
  describe_particles(particles, state.grains, state.step, state.time, setup.numerics.dt);

  const Saver ours(root.create("soilbin"));
  const Saver of_state = ours.inner("state");
  describe_setup(ours.inner("setup"), setup);
  of_state.length("grains", state.grains.id);
  describe_state(of_state, state);
  describe_grains(ours.inner("grains"), state.grains);
  const FlatSurfaces surfaces = flat(state.surfaces);
  describe_surfaces(ours.inner("surfaces"), surfaces);
  const std::vector<SharedMesh> meshes = meshes_of(state.bodies);
  save_meshes(ours.inner("meshes"), meshes);
  save_bodies(ours.inner("bodies"), state.bodies, meshes);
  if (!state.clumps.all.empty()) describe_clumps(ours.inner("clumps"), state.clumps, state.grains.clump);
  save_notes(ours.inner("notes").group(), notes);
}

Grains load_grains(const hdf5::Group& root, Clumps& clumps) {
  const Loader ours(root.open("soilbin"));
  Grains grains;
  std::uint64_t told = 0;
  ours.inner("state").value("grains", told);
  const hdf5::Group ids = root.open("particles").open("grains").open("id");
  if (ids.shape("value") != hdf5::Shape{1, told})
    throw InputError({ids.place("value"), 0, 0}, "contradicts the rest", "", "the file is of another program");
  grains.id.resize(told);
  const std::size_t count = grains.id.size();
  grains.motion.resize(count);
  grains.spin.resize(count);
  grains.load.resize(count);
  grains.material.resize(count);
  grains.clump.assign(count, lone);
  describe_particles(Loader(root.open("particles").open("grains")), grains, 0, 0, 0);
  describe_grains(ours.inner("grains"), grains);
  if (ours.group().has("clumps")) describe_clumps(ours.inner("clumps"), clumps, grains.clump);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  grains.reorder(order);  // brings the idle rows back
  return grains;
}

Restart load(const hdf5::Group& root, const std::string& file) {
  Restart run;
  const Loader ours(root.open("soilbin"));
  describe_setup(ours.inner("setup"), run.setup);
  describe_state(ours.inner("state"), run.state);
  run.state.grains = load_grains(root, run.state.clumps);
  FlatSurfaces surfaces;
  describe_surfaces(ours.inner("surfaces"), surfaces);
  run.state.surfaces = by_slab(surfaces, file);
  load_bodies(ours.inner("bodies"), run.state.bodies, load_meshes(ours.inner("meshes")));
  run.notes = load_notes(root.open("soilbin").open("notes"));
  check_restart(run.setup, run.state, file);
  return run;
}

}  // namespace

void write_restart(const fs::path& path, const Setup& setup, const State& state, const Notes& notes, Keep keep) {
  hdf5::OutputFile file(path.string());
  save(file.root(), setup, state, notes);
  write_sealed(path, restart_kind, file.finish(), keep);
}

Restart read_restart(const fs::path& path) {
  try {
    const SealedFile sealed(path, restart_kind);
    return load(hdf5::InputFile(sealed.content(), path.string()).root(), path.string());
  } catch (const std::bad_alloc&) {
    throw InputError({path.string(), 0, 0}, "needs more memory than there is");
  } catch (const std::length_error&) {
    throw InputError({path.string(), 0, 0}, "has lengths that can't be", "", "the file is of another program");
  }
}

bool has_restart(const fs::path& path) { return is_there(path) || is_there(previous_of(path)); }

void remove_restart(const fs::path& path) {
  if (path.empty()) return;
  std::error_code gone_already;
  fs::remove(path, gone_already);
  fs::remove(previous_of(path), gone_already);
}

LastGood read_last_good(const fs::path& path) {
  std::string why;
  try {
    return {read_restart(path), path, ""};
  } catch (const InputError& error) {
    why = error.what();
  }
  const fs::path previous = previous_of(path);
  try {
    return {read_restart(previous), previous, fmt::format("{}\n  going on from {} instead", why, previous.string())};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}\nand the one before it:\n{}", why, error.what()));
  }
}

}  // namespace soilbin::dem
