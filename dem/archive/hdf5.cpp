#include "dem/archive/hdf5.hpp"

#include <H5Cpp.h>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "scenario/errors.hpp"

namespace soilbin::dem::hdf5 {

struct Group::Handle {
  H5::Group group;
  std::string file, path;
};

namespace {

constexpr std::size_t chunk_bytes = 256 * 1024, compact_bytes = 1024;
constexpr int fastest_deflate = 1;

H5::PredType in_file(Number number) {
  switch (number) {
    case Number::f64:
      return H5::PredType::IEEE_F64LE;
    case Number::f32:
      return H5::PredType::IEEE_F32LE;
    case Number::i64:
      return H5::PredType::STD_I64LE;
    case Number::i32:
      return H5::PredType::STD_I32LE;
    case Number::u64:
      return H5::PredType::STD_U64LE;
    case Number::u32:
      return H5::PredType::STD_U32LE;
    case Number::u16:
      return H5::PredType::STD_U16LE;
    case Number::u8:
      return H5::PredType::STD_U8LE;
  }
  throw std::logic_error("no such number");
}

H5::PredType in_memory(Number number) {
  switch (number) {
    case Number::f64:
      return H5::PredType::NATIVE_DOUBLE;
    case Number::f32:
      return H5::PredType::NATIVE_FLOAT;
    case Number::i64:
      return H5::PredType::NATIVE_INT64;
    case Number::i32:
      return H5::PredType::NATIVE_INT32;
    case Number::u64:
      return H5::PredType::NATIVE_UINT64;
    case Number::u32:
      return H5::PredType::NATIVE_UINT32;
    case Number::u16:
      return H5::PredType::NATIVE_UINT16;
    case Number::u8:
      return H5::PredType::NATIVE_UINT8;
  }
  throw std::logic_error("no such number");
}

/// Runs what calls HDF5, and tells the place where it fails.
template <class Act>
auto writing(const std::string& place, const Act& act) {
  H5::Exception::dontPrint();
  try {
    return act();
  } catch (const H5::Exception& error) {
    throw std::runtime_error(fmt::format("{}: can't be written: {}", place, error.getDetailMsg()));
  }
}

template <class Act>
auto reading(const std::string& place, const Act& act) {
  H5::Exception::dontPrint();
  try {
    return act();
  } catch (const H5::Exception& error) {
    throw InputError({place, 0, 0}, fmt::format("can't be read: {}", error.getDetailMsg()), "",
                     "the file is damaged, or of another program");
  }
}

void require(bool done) {
  if (!done) throw H5::Exception("", "HDF5 refuses");
}

H5::DataSpace space_of(const Shape& shape) {
  const std::vector<hsize_t> lengths(shape.begin(), shape.end());
  return lengths.empty() ? H5::DataSpace(H5S_SCALAR) : H5::DataSpace(static_cast<int>(lengths.size()), lengths.data());
}

Shape shape_of(const H5::DataSpace& space) {
  std::vector<hsize_t> lengths(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  if (!lengths.empty()) space.getSimpleExtentDims(lengths.data());
  return {lengths.begin(), lengths.end()};
}

/// Full along all but the first dimension that is longer than one, which is cut.
std::vector<hsize_t> chunk_of(const Shape& shape, std::size_t number_bytes) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  std::size_t cut = 0;
  while (cut + 1 < chunk.size() && chunk[cut] == 1) ++cut;
  hsize_t row = number_bytes;
  for (std::size_t k = cut + 1; k < chunk.size(); ++k) row *= chunk[k];
  chunk[cut] = std::clamp<hsize_t>(chunk_bytes / row, 1, chunk[cut]);
  return chunk;
}

H5::DSetCreatPropList layout_of(const Shape& shape, std::size_t number_bytes) {
  H5::DSetCreatPropList how;
  require(H5Pset_obj_track_times(how.getId(), false) >= 0);
  std::size_t bytes = number_bytes;
  for (const std::uint64_t length : shape) bytes *= length;
  if (bytes <= compact_bytes) {
    if (bytes > 0) how.setLayout(H5D_COMPACT);
    return how;
  }
  const std::vector<hsize_t> chunk = chunk_of(shape, number_bytes);
  how.setChunk(static_cast<int>(chunk.size()), chunk.data());
  how.setFillTime(H5D_FILL_TIME_NEVER);
  how.setShuffle();
  how.setDeflate(fastest_deflate);
  how.setFletcher32();
  return how;
}

/// Properties of groups: no times, and many attributes and names kept close together.
template <class Properties>
void keep_plain(const Properties& properties) {
  require(H5Pset_obj_track_times(properties.getId(), false) >= 0);
  require(H5Pset_attr_phase_change(properties.getId(), 200, 0) >= 0);
  require(H5Pset_link_phase_change(properties.getId(), 200, 0) >= 0);
}

H5::StrType text_of(std::size_t length) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(length, 1));
  type.setStrpad(H5T_STR_NULLPAD);
  type.setCset(H5T_CSET_UTF8);
  return type;
}

/// What is allowed of a file, and what has been seen of it.
struct Inspection {
  static constexpr hsize_t most_objects = 10'000, most_attributes = 1'000;
  static constexpr hsize_t free_bytes = 64U << 20U, most_unpacking = 128;  // of the whole file
  static constexpr hsize_t most_inflating = 1100, compact = 4096;          // of a dataset: deflate's own limit is 1032

  std::size_t file_bytes;
  hsize_t objects = 0, bytes = 0;
  std::string refused{};  ///< the place, and why

  bool refuse(const std::string& name, const char* why) {
    if (refused.empty()) refused = fmt::format("/{} {}", name, why);
    return false;
  }

  bool allows_filters(const std::string& name, const H5::DSetCreatPropList& how) {
    for (int k = 0; k < how.getNfilters(); ++k) {
      std::size_t values = 0;
      unsigned flags = 0, setting = 0;
      const H5Z_filter_t filter = how.getFilter(k, flags, values, nullptr, 0, nullptr, setting);
      if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_FLETCHER32)
        return refuse(name, "goes through a filter that soilbin doesn't use");
    }
    return true;
  }

  bool allows_dataset(const std::string& name, const H5::DataSet& set) {
    const H5::DSetCreatPropList how = set.getCreatePlist();
    if (how.getLayout() == H5D_VIRTUAL) return refuse(name, "is a virtual dataset, made of others");
    if (how.getExternalCount() > 0) return refuse(name, "lies in another file");
    if (!allows_filters(name, how)) return false;
    const H5T_class_t kind = set.getTypeClass();
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) return refuse(name, "has no numbers");
    hsize_t size = set.getDataType().getSize();
    for (const std::uint64_t length : shape_of(set.getSpace())) {
      constexpr hsize_t beyond_all = hsize_t{1} << 40U;
      if (length != 0 && size > beyond_all / length) return refuse(name, "is larger than any file");
      size *= length;
    }
    bytes += size;
    if (size > most_inflating * set.getStorageSize() + compact || bytes > free_bytes + most_unpacking * file_bytes)
      return refuse(name, "is larger than the file can hold");
    return true;
  }

  bool allows(hid_t group, const char* name, const H5L_info_t& link) {
    if (++objects > most_objects) return refuse(name, "is one object too many");
    if (link.type != H5L_TYPE_HARD) return refuse(name, "is a link");
    const hid_t id = H5Oopen(group, name, H5P_DEFAULT);
    require(id >= 0);
    const H5I_type_t kind = H5Iget_type(id);
    bool allowed = false;
    if (kind == H5I_DATASET) {
      const H5::DataSet set(id);
      allowed = set.getNumAttrs() <= static_cast<int>(most_attributes) ? allows_dataset(name, set)
                                                                       : refuse(name, "has too many attributes");
    } else if (kind == H5I_GROUP) {
      const H5::Group here(id);
      allowed = here.getNumAttrs() <= static_cast<int>(most_attributes) || refuse(name, "has too many attributes");
    } else {
      refuse(name, "is neither numbers nor a group of them");
    }
    H5Oclose(id);
    return allowed;
  }
};

/// Called by HDF5 for each link: no exception may pass.
herr_t inspect_link(hid_t group, const char* name, const H5L_info_t* link, void* inspection) {
  auto& seen = *static_cast<Inspection*>(inspection);
  try {
    return seen.allows(group, name, *link) ? 0 : 1;
  } catch (const H5::Exception& error) {
    seen.refuse(name, "can't be read");
    return 1;
  } catch (const std::exception&) {
    seen.refuse(name, "can't be looked at");
    return 1;
  }
}

void inspect(const H5::H5File& file, std::size_t bytes, const std::string& name) {
  Inspection seen{.file_bytes = bytes};
  const herr_t status = H5Lvisit(file.getId(), H5_INDEX_NAME, H5_ITER_NATIVE, inspect_link, &seen);
  if (seen.refused.empty()) return require(status >= 0);
  throw InputError({name + ": " + seen.refused.substr(0, seen.refused.find(' ')), 0, 0},
                   seen.refused.substr(seen.refused.find(' ') + 1), "", "the file is not as soilbin wrote it");
}

/// HDF5 takes two open files of one name for the same, in memory too.
std::string unused_name() {
  static std::atomic<std::uint64_t> count{0};
  return fmt::format("soilbin-memory-{}", count++);
}

H5::FileAccPropList in_memory_only() {
  H5::FileAccPropList access;
  access.setCore(4 << 20, false);
  access.setLibverBounds(H5F_LIBVER_V18, H5F_LIBVER_V18);  // superblock 2, as H5MD recommends
  return access;
}

}  // namespace

std::string Group::place(const std::string& name) const {
  std::string path = handle_->path;
  if (!name.empty()) path += (path == "/" ? "" : "/") + name;
  return handle_->file + ": " + path;
}

Group Group::create(const std::string& name) const {
  return writing(place(name), [&] {
    const H5::PropList properties(H5P_GROUP_CREATE);
    keep_plain(properties);
    const hid_t id = H5Gcreate2(handle_->group.getId(), name.c_str(), H5P_DEFAULT, properties.getId(), H5P_DEFAULT);
    require(id >= 0);
    H5::Group made(id);  // takes a share of its own
    require(H5Idec_ref(id) >= 0);
    return Group(std::make_shared<Handle>(made, handle_->file, place(name).substr(handle_->file.size() + 2)));
  });
}

Group Group::open(const std::string& name) const {
  return reading(place(name), [&] {
    return Group(std::make_shared<Handle>(handle_->group.openGroup(name), handle_->file,
                                          place(name).substr(handle_->file.size() + 2)));
  });
}

bool Group::has(const std::string& name) const {
  return reading(place(name), [&] { return handle_->group.nameExists(name); });
}

void Group::write(const std::string& name, Number number, const Shape& shape, const void* data) const {
  writing(place(name), [&] {
    const H5::PredType type = in_file(number);
    const H5::DataSet set = handle_->group.createDataSet(name, type, space_of(shape), layout_of(shape, type.getSize()));
    set.write(data, in_memory(number));
  });
}

Shape Group::shape(const std::string& name) const {
  return reading(place(name), [&] { return shape_of(handle_->group.openDataSet(name).getSpace()); });
}

void Group::read(const std::string& name, Number number, const Shape& shape, void* data) const {
  reading(place(name), [&] {
    const H5::DataSet set = handle_->group.openDataSet(name);
    if (!(set.getDataType() == in_file(number)) || shape_of(set.getSpace()) != shape)
      throw InputError({place(name), 0, 0}, "has other numbers or another shape than expected", "",
                       "the file is of another program");
    set.read(data, in_memory(number));
  });
}

std::vector<std::string> Group::names() const {
  return reading(place(), [&] {
    std::vector<std::string> names;
    for (hsize_t k = 0; k < handle_->group.getNumObjs(); ++k) names.push_back(handle_->group.getObjnameByIdx(k));
    return names;
  });
}

void Group::set_numbers(const std::string& name, Number number, const Shape& shape, const void* data) const {
  writing(place(name), [&] {
    handle_->group.createAttribute(name, in_file(number), space_of(shape)).write(in_memory(number), data);
  });
}

void Group::get_numbers(const std::string& name, Number number, const Shape& shape, void* data) const {
  reading(place(name), [&] {
    const H5::Attribute attribute = handle_->group.openAttribute(name);
    if (!(attribute.getDataType() == in_file(number)) || shape_of(attribute.getSpace()) != shape)
      throw InputError({place(name), 0, 0}, "has other numbers or another shape than expected", "",
                       "the file is of another program");
    attribute.read(in_memory(number), data);
  });
}

void Group::set_text(const std::string& name, const std::string& text) const {
  writing(place(name), [&] {
    const H5::StrType type = text_of(text.size());
    std::string filled = text;
    filled.resize(type.getSize(), '\0');
    handle_->group.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, filled.data());
  });
}

std::string Group::get_text(const std::string& name) const {
  return reading(place(name), [&] {
    const H5::Attribute attribute = handle_->group.openAttribute(name);
    const H5::DataType type = attribute.getDataType();
    if (type.getClass() != H5T_STRING || H5Tis_variable_str(type.getId()) != 0 ||
        !shape_of(attribute.getSpace()).empty())
      throw InputError({place(name), 0, 0}, "is not a text", "", "the file is of another program");
    constexpr std::size_t longest = 1U << 20U;
    if (type.getSize() > longest)
      throw InputError({place(name), 0, 0}, "is longer than any text", "", "the file is of another program");
    std::string text(type.getSize(), '\0');
    attribute.read(type, text.data());
    text.resize(text.find_last_not_of('\0') + 1);
    return text;
  });
}

std::vector<std::string> Group::text_names() const {
  return reading(place(), [&] {
    std::vector<std::string> names;
    for (unsigned k = 0; k < static_cast<unsigned>(handle_->group.getNumAttrs()); ++k)
      names.push_back(handle_->group.openAttribute(k).getName());
    return names;
  });
}

void Group::set_texts(const std::string& name, const std::vector<std::string>& texts) const {
  writing(place(name), [&] {
    std::size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, text.size());
    std::string filled;
    for (const std::string& text : texts) filled += text + std::string(longest - text.size(), '\0');
    const H5::StrType type = text_of(longest);
    handle_->group.createAttribute(name, type, space_of({texts.size()})).write(type, filled.data());
  });
}

void Group::set_free_text(const std::string& name, const std::string& text, const std::string& of) const {
  writing(place(of.empty() ? name : of + "/" + name), [&] {
    const H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
    const auto set = [&](const H5::H5Object& object) {
      object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, text);
    };
    of.empty() ? set(handle_->group) : set(handle_->group.openDataSet(of));
  });
}

/// The file, and when it is closed its memory. H5Fget_file_image would be simpler, but in 1.10.8 what it gives has a
/// superblock whose checksum is wrong.
struct OutputFile::Building {
  H5::H5File file;
  char* memory = nullptr;

  ~Building() { std::free(memory); }

  /// Makes HDF5 leave the memory to us as it closes the file.
  void take_memory_from(const H5::FileAccPropList& access) {
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_realloc = [](void* at, std::size_t size, H5FD_file_image_op_t, void*) {
      return std::realloc(at, size);
    };
    callbacks.image_free = [](void* at, H5FD_file_image_op_t, void* building) -> herr_t {
      static_cast<Building*>(building)->memory = static_cast<char*>(at);
      return 0;
    };
    callbacks.udata_copy = [](void* building) { return building; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = this;
    require(H5Pset_file_image_callbacks(access.getId(), &callbacks) >= 0);
  }
};

OutputFile::OutputFile(const std::string& name)
    : building_(std::make_unique<Building>()), root_(writing(name, [&] {
        const H5::FileCreatPropList properties;
        keep_plain(properties);
        const H5::FileAccPropList access = in_memory_only();
        access.setFcloseDegree(H5F_CLOSE_STRONG);
        building_->take_memory_from(access);
        building_->file = H5::H5File(unused_name(), H5F_ACC_TRUNC, properties, access);
        return Group(std::make_shared<Group::Handle>(building_->file.openGroup("/"), name, "/"));
      })) {}

OutputFile::~OutputFile() = default;

std::string_view OutputFile::finish() {
  return writing(root_.place(), [&] {
    building_->file.close();
    require(building_->memory != nullptr);
    std::uint64_t end = 0;  // superblock 2 tells where the file ends
    std::memcpy(&end, building_->memory + 28, sizeof(end));
    return std::string_view(building_->memory, end);
  });
}

InputFile::InputFile(std::string_view image, const std::string& name)
    : root_(reading(name, [&] {
        const H5::FileAccPropList access = in_memory_only();
        // HDF5 copies the image; it only lacks a const.
        require(H5Pset_file_image(access.getId(), const_cast<char*>(image.data()), image.size()) >= 0);
        const H5::H5File file(unused_name(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access);
        inspect(file, image.size(), name);
        return Group(std::make_shared<Group::Handle>(file.openGroup("/"), name, "/"));
      })) {}

}  // namespace soilbin::dem::hdf5
