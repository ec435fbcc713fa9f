#include "wilt/simulation/checkpoint.hpp"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/hash.hpp"
#include "wilt/core/version.hpp"
#include "wilt/core/whole_number.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "wilt checkpoint 1\n";
constexpr std::size_t kHashLength = 17;  // with the line feed

std::string hash_line(std::string_view bytes) {
  return fmt::format("{:016x}\n", hash_bytes(bytes));
}

// Takes `count` bytes off the front.
std::string_view take(std::string_view& bytes, std::size_t count) {
  if (count > bytes.size()) throw Error(ErrorCode::input, "it ends too early");
  const std::string_view front = bytes.substr(0, count);
  bytes.remove_prefix(count);
  return front;
}

int count_at(const Json& json, const char* key) {
  const std::optional<int> count = whole_number(json.at(key));
  if (!count)
    throw Error(ErrorCode::input,
                fmt::format("'{}' is no whole number from 0 to {}", key, std::numeric_limits<int>::max()));
  return *count;
}

Eigen::MatrixXd take_array(std::string_view& bytes, const Json& entry) {
  const int rows = count_at(entry, "rows"), columns = count_at(entry, "columns");
  const std::uint64_t count = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
  if (count > bytes.size() / sizeof(double)) throw Error(ErrorCode::input, "it ends too early");
  const std::string_view numbers = take(bytes, sizeof(double) * static_cast<std::size_t>(count));
  Eigen::MatrixXd array(rows, columns);
  if (count > 0) std::memcpy(array.data(), numbers.data(), numbers.size());
  if (!array.allFinite())
    throw Error(ErrorCode::input,
                fmt::format("'{}' holds a number that is not finite", entry.at("name").get<std::string>()));
  return array;
}

Checkpoint parse(std::string_view bytes) {
  const std::string_view hashed = bytes.substr(0, bytes.size() - kHashLength);
  if (bytes.substr(hashed.size()) != hash_line(hashed))
    throw Error(ErrorCode::input, "it was cut off or changed");
  std::string_view rest = hashed.substr(kMagic.size());
  const std::size_t head = rest.find('\n');
  if (head == std::string_view::npos) throw Error(ErrorCode::input, "it ends too early");
  const Json json = Json::parse(take(rest, head));
  take(rest, 1);
  Checkpoint checkpoint;
  checkpoint.version = json.at("version").get<std::string>();
  checkpoint.config = json.at("config").dump();
  checkpoint.leaf = json.at("leaf").get<std::string>();
  checkpoint.iteration = count_at(json, "iteration");
  for (const Json& entry : json.at("arrays"))
    checkpoint.arrays[entry.at("name").get<std::string>()] = take_array(rest, entry);
  if (!rest.empty()) throw Error(ErrorCode::input, fmt::format("{} bytes too many", rest.size()));
  return checkpoint;
}

// Chained hashes of arrays.
class Fingerprint {
 public:
  template <class Derived>
  void add(const Eigen::PlainObjectBase<Derived>& matrix) {
    add_number(hash_entries(matrix));
  }
  void add_number(std::uint64_t number) { hash_ = mix_hash(hash_, number); }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0;
};

// "water.humidity was 0.5 and is 0.4", for the first keys that differ.
std::string differences(const std::string& before, const std::string& now) {
  constexpr int kMost = 3;
  const Json old = Json::parse(before), current = Json::parse(now);
  std::string text;
  int found = 0;
  for (const auto& [key, value] : current.items()) {
    const Json was = old.is_object() && old.contains(key) ? old[key] : Json();
    if (was == value || ++found > kMost) continue;
    text += fmt::format("{}{} was {} and is {}", text.empty() ? "" : ", ", key, was.dump(), value.dump());
  }
  return found > kMost ? fmt::format("{} and {} more", text, found - kMost) : text;
}

}  // namespace

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  Json arrays = Json::array();
  std::size_t numbers = 0;
  for (const auto& [name, array] : checkpoint.arrays) {
    arrays.push_back({{"name", name}, {"rows", array.rows()}, {"columns", array.cols()}});
    numbers += static_cast<std::size_t>(array.size());
  }
  const Json head = {{"version", checkpoint.version},
                     {"config", Json::parse(checkpoint.config)},
                     {"leaf", checkpoint.leaf},
                     {"iteration", checkpoint.iteration},
                     {"arrays", std::move(arrays)}};
  std::string bytes(kMagic);
  bytes += head.dump() + "\n";
  bytes.reserve(bytes.size() + sizeof(double) * numbers + kHashLength);
  for (const auto& entry : checkpoint.arrays)
    bytes.append(reinterpret_cast<const char*>(entry.second.data()),
                 sizeof(double) * static_cast<std::size_t>(entry.second.size()));
  return bytes + hash_line(bytes);
}

Checkpoint parse_checkpoint(std::string_view bytes, const std::string& name) {
  const auto refuse = [&name](const std::string& reason) {
    throw Error(ErrorCode::input,
                fmt::format("'{}' cannot be resumed from: {}; delete it to begin anew", name, reason));
  };
  if (bytes.substr(0, kMagic.size()) != kMagic || bytes.size() < kMagic.size() + kHashLength)
    throw Error(ErrorCode::input,
                fmt::format("'{}' is not a checkpoint; give the file that --checkpoint wrote", name));
  try {
    return parse(bytes);
  } catch (const Error& error) {
    refuse(error.what());
  } catch (const nlohmann::json::exception& error) {
    refuse(error.what());
  }
  return {};
}

std::string run_fingerprint(const Leaf& leaf, const Venation& venation) {
  Fingerprint print;
  print.add(leaf.mesh.face_matrix());
  print.add(leaf.positions);
  print.add(leaf.stalk.centreline);
  print.add_number(static_cast<std::uint64_t>(static_cast<int>(leaf.petiole)));
  for (const Tip& tip : venation.tips)
    print.add_number(static_cast<std::uint64_t>(static_cast<int>(tip.vertex)));
  for (const Vein& vein : venation.veins) {
    for (const SurfacePoint& point : vein.path.points) {
      print.add_number(static_cast<std::uint64_t>(static_cast<int>(point.face)));
      print.add(point.barycentric);
    }
  }
  print.add(venation.primary_distance);
  print.add(venation.vein_distance);
  print.add(venation.tip_distance);
  return print.text();
}

void require_same_run(const Checkpoint& checkpoint, const std::string& config, const std::string& leaf) {
  if (checkpoint.version != version())
    throw Error(ErrorCode::input,
                fmt::format("it is of wilt {}, this is wilt {}", checkpoint.version, version()));
  if (checkpoint.config != config)
    throw Error(ErrorCode::input,
                "it is of another configuration: " + differences(checkpoint.config, config));
  if (checkpoint.leaf != leaf) throw Error(ErrorCode::input, "it is of another leaf, or of other veins");
}

void exchange_result(StateArchive& archive, SimulationResult& result) {
  using M = FrameMetrics;
  using S = StepRow;
  using F = ForceRow;
  archive.rows("metrics", result.metrics, &M::iteration, &M::wrinkle, &M::curl, &M::area_ratio,
               &M::projected_area_ratio, &M::max_strain, &M::self_intersections);
  archive.rows("steps", result.steps, &S::iteration, &S::dt, &S::newton, &S::linear, &S::residual,
               &S::converged, &S::kinetic, &S::elastic, &S::bending, &S::water);
  archive.rows("forces", result.forces, &F::iteration, &F::region, &F::elastic, &F::damping, &F::swelling,
               &F::external, &F::water, &F::pressure);
  for (const ForceRow& row : result.forces) {
    if (row.region > Region::mesophyll) throw Error(ErrorCode::input, "'forces' names a region that is none");
  }
  const Frame at_rest = result.frames.front();
  result.frames.resize(result.metrics.size(), at_rest);
  for (std::size_t k = 0; k < result.frames.size(); ++k) {
    Frame& frame = result.frames[k];
    frame.iteration = result.metrics[k].iteration;
    archive.matrix(fmt::format("frames.{}.positions", k), frame.positions);
    archive.matrix(fmt::format("frames.{}.stalk", k), frame.stalk);
    archive.matrix(fmt::format("frames.{}.water_fraction", k), frame.water_fraction);
    archive.matrix(fmt::format("frames.{}.dryness", k), frame.dryness);
  }
}

}  // namespace wilt
