#include "compare/replay/replay.hpp"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "compare/report/json_fields.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {
namespace {

constexpr double most_steps = 65535;
constexpr std::size_t largest_replay = 256U << 20U;  // [bytes]; a page with one is a third larger

/// Bytes before compression that a browser takes in one piece.
constexpr std::uint64_t largest_payload = 2ULL << 30U;

/// The grid on which places are told.
struct Raster {
  Point origin{};
  double step = 1.0;

  std::uint16_t at(double x, std::size_t axis) const {
    return static_cast<std::uint16_t>(std::clamp(std::round((x - origin[axis]) / step), 0.0, most_steps));
  }
};

Raster raster_of(const Replay& replay) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Point low{far, far, far}, high{-far, -far, -far};
  for (const ReplayFrame& frame : replay.frames)
    for (const Point& grain : frame.grains)
      for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], grain[a]), high[a] = std::max(high[a], grain[a]);
  double extent = 0.0;
  for (std::size_t a = 0; a < 3; ++a) extent = std::max(extent, high[a] - low[a]);
  if (!std::isfinite(extent)) return {};
  return {low, extent > 0.0 ? extent / most_steps : 1e-6};
}

std::vector<std::size_t> order_by_place(const std::vector<Point>& grains) {
  std::vector<std::size_t> order(grains.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return grains[a] < grains[b]; });
  return order;
}

/// Little-endian bytes of the payload, low and high bytes of 16-bit numbers in planes of their own.
class Payload {
 public:
  void planes(const std::vector<std::uint16_t>& values) {
    for (const std::uint16_t v : values) bytes_ += static_cast<char>(v & 0xFF);
    for (const std::uint16_t v : values) bytes_ += static_cast<char>(v >> 8);
  }
  void byte(std::uint8_t v) { bytes_ += static_cast<char>(v); }
  void number(std::uint32_t v) {
    for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>((v >> shift) & 0xFF);
  }
  void single(double value) {
    const auto narrow = static_cast<float>(value);
    number(std::bit_cast<std::uint32_t>(narrow));
  }
  std::string deflated() const {
    uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes_.data()),
                  static_cast<uLong>(bytes_.size()), Z_BEST_COMPRESSION) != Z_OK)
      throw std::runtime_error("replay: zlib could not compress it");
    out.resize(size);
    return out;
  }

 private:
  std::string bytes_;
};

/// A change modulo 2^16 with its sign in the lowest bit: small changes of either sign are small numbers.
std::uint16_t zigzag(std::uint16_t now, std::uint16_t before) {
  const auto change = static_cast<std::int16_t>(static_cast<std::uint16_t>(now - before));
  return static_cast<std::uint16_t>((static_cast<std::uint16_t>(change) << 1) ^
                                    static_cast<std::uint16_t>(change < 0 ? 0xFFFF : 0));
}

void add_frames(const Replay& replay, const Raster& grid, const std::vector<std::size_t>& order, Payload& payload) {
  std::array<std::vector<std::uint16_t>, 3> before;
  for (auto& axis : before) axis.assign(order.size(), 0);
  for (const ReplayFrame& frame : replay.frames)
    for (std::size_t a = 0; a < 3; ++a) {
      std::vector<std::uint16_t> changes(order.size());
      for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint16_t now = grid.at(frame.grains[order[k]][a], a);
        changes[k] = zigzag(now, before[a][k]);
        before[a][k] = now;
      }
      payload.planes(changes);
    }
}

double largest_pressing(const Replay& replay) {
  double most = 0.0;
  for (const ReplayFrame& frame : replay.frames)
    for (const double force : frame.pressing) most = std::max(most, force);
  return most;
}

void add_pressing(const Replay& replay, const std::vector<std::size_t>& order, Payload& payload) {
  const double most = largest_pressing(replay);
  if (most == 0.0) return;
  for (const ReplayFrame& frame : replay.frames)
    for (const std::size_t k : order)
      payload.byte(static_cast<std::uint8_t>(
          std::lround(255 * std::sqrt(std::clamp(frame.pressing.empty() ? 0.0 : frame.pressing[k] / most, 0.0, 1.0)))));
}

/// Number of bytes before they are compressed.
std::uint64_t payload_size(std::uint64_t grains, std::uint64_t frames, std::uint64_t vertices, std::uint64_t triangles,
                           bool with_pressing) {
  return 4 * grains + 12 * vertices + 12 * triangles + (with_pressing ? 7 : 6) * grains * frames;
}

/// Number of bytes by a replay's header; counts have 32 bits, so that their products do not overflow.
std::uint64_t payload_size(const Json& header, const std::string& place) {
  const auto count = [&](const char* key) {
    const Json& value = header.at(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max() / 8)
      throw InputError(fmt::format("{}: {} is no count", place, key));
    return value.get<std::uint64_t>();
  };
  return payload_size(count("grains"), count("frames"), count("vertices"), count("triangles"),
                      header.contains("pressing"));
}

/// Lists that a page goes through frame by frame: as many entries as frames, each of so many finite numbers.
void check_frames(const Json& header, std::size_t frames, const std::string& place) {
  const auto check = [&](const char* key, std::size_t numbers, bool older_files_have_it) {
    if (!older_files_have_it && !header.contains(key)) return;
    const Json& list = header.at(key);
    const auto fits = [&](const Json& entry) {
      if (numbers == 0) return entry.is_number() && std::isfinite(entry.get<double>());
      return entry.is_array() && entry.size() == numbers && std::ranges::all_of(entry, [](const Json& one) {
               return one.is_number() && std::isfinite(one.get<double>());
             });
    };
    if (!list.is_array() || list.size() != frames || !std::ranges::all_of(list, fits))
      throw InputError(fmt::format("{}: {} has not an entry for each of {} frames\n  hint: make the replay again",
                                   place, key, frames));
  };
  if (frames == 0) throw InputError(fmt::format("{}: there are no frames\n  hint: make the replay again", place));
  check("times", 0, true), check("wheel", 3, true), check("rotation", 4, true);
  check("force", 3, false), check("torque", 3, false);
}

/// Refuses a payload that doesn't come out whole, by zlib's own checksum, or with another size.
void check_payload(std::string_view deflated, std::uint64_t size, const std::string& file) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("replay: zlib could not begin");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(deflated.data()));  // zlib only reads it
  stream.avail_in = static_cast<uInt>(deflated.size());
  std::array<Bytef, 1 << 16> piece{};
  int status = Z_OK;
  while (status == Z_OK && stream.total_out <= size) {
    stream.next_out = piece.data(), stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
  }
  const bool whole = status == Z_STREAM_END && stream.total_out == size && stream.avail_in == 0;
  inflateEnd(&stream);
  if (!whole)
    throw InputError(
        fmt::format("{}: is cut short or damaged\n  hint: take a copy of the file, or make it again", file));
}

Json header_of(const Replay& replay, const Raster& grid) {
  Json header = {{"format", replay_format}, {"title", replay.title}, {"facts", Json::array()}};
  for (const auto& [name, value] : replay.facts) header["facts"].push_back({name, value});
  header["grains"] = replay.radii.size();
  header["frames"] = replay.frames.size();
  header["vertices"] = replay.tire.size();
  header["triangles"] = replay.triangles.size();
  header["origin"] = grid.origin;
  header["step"] = grid.step;
  header["surface"] = replay.surface;
  for (const char* key : {"times", "wheel", "rotation", "force", "torque"}) header[key] = Json::array();
  for (const ReplayFrame& frame : replay.frames) {
    header["times"].push_back(frame.time);
    header["wheel"].push_back(frame.wheel);
    header["rotation"].push_back(frame.rotation);
    header["force"].push_back(frame.force);
    header["torque"].push_back(frame.torque);
  }
  if (replay.bin)
    header["bin"] = {{"lower", replay.bin->lower}, {"upper", replay.bin->upper}, {"periodic", replay.bin->periodic}};
  if (const double most = largest_pressing(replay); most > 0.0) header["pressing"] = most;
  put_seal(header);
  return header;
}

}  // namespace

void thin_out(Replay& replay) {
  const auto size_of = [&](std::size_t frames) {
    return payload_size(replay.radii.size(), frames, replay.tire.size(), replay.triangles.size(), true);
  };
  while (replay.frames.size() > 2 && size_of(replay.frames.size()) > largest_payload) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < replay.frames.size(); k += 2) replay.frames[kept++] = std::move(replay.frames[k]);
    replay.frames.resize(kept);
  }
}

std::string replay_bytes(const Replay& replay) {
  if (replay.frames.empty()) throw InputError("a replay needs at least one frame");
  for (const ReplayFrame& frame : replay.frames)
    if (frame.grains.size() != replay.radii.size() ||
        (!frame.pressing.empty() && frame.pressing.size() != replay.radii.size()))
      throw InputError(fmt::format("a replay's frames must hold the same grains: {} and {}", frame.grains.size(),
                                   replay.radii.size()));
  const Raster grid = raster_of(replay);
  const std::vector<std::size_t> order = order_by_place(replay.frames.front().grains);
  Payload payload;
  for (const std::size_t k : order) payload.single(replay.radii[k]);
  for (const Point& vertex : replay.tire)
    for (const double x : vertex) payload.single(x);
  for (const auto& triangle : replay.triangles)
    for (const std::uint32_t corner : triangle) payload.number(corner);
  add_frames(replay, grid, order, payload);
  add_pressing(replay, order, payload);
  return header_of(replay, grid).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" + payload.deflated();
}

ReplayFile read_replay(const std::filesystem::path& path) {
  const std::string hint = "soilbin run STUDY --model dem --replay FILE writes one";
  ReplayFile file;
  file.bytes = read_bytes(path, largest_replay);
  const std::size_t end = file.bytes.find('\n');
  if (end == std::string::npos)
    throw InputError(fmt::format("{}: no replay ({})\n  hint: {}", path.string(), replay_format, hint));
  const Json header = parse_json(make_source_text(file.bytes.substr(0, end), path.string()), hint);
  if (!header.is_object() || header.value("format", Json()) != replay_format)
    throw InputError(fmt::format("{}: no replay ({})\n  hint: {}", path.string(), replay_format, hint));
  const std::string place = path.string() + ": its first line";
  check_seal(header, place, "take a copy of the file, or make it again");
  read_json_at(place, [&] {
    file.title = header.at("title");
    for (const Json& fact : header.at("facts")) file.facts.emplace_back(fact.at(0), fact.at(1));
    file.grains = header.at("grains");
    file.frames = header.at("frames");
    const std::uint64_t size = payload_size(header, place);
    if (size > largest_payload)
      throw InputError(
          fmt::format("{}: {} grains in {} frames are {} bytes, more than the {} that a page takes\n"
                      "  hint: a replay of fewer grains",
                      place, file.grains, file.frames, size, largest_payload));
    check_frames(header, file.frames, place);
    file.seconds = header.at("times").back().get<double>() - header.at("times").front().get<double>();
    check_payload(std::string_view(file.bytes).substr(end + 1), size, path.string());
    return 0;
  });
  return file;
}

}  // namespace soilbin::compare
