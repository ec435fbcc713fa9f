// A withered leaf as a GLB: its colours and textures, its bytes, the file.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "bench/maple.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/gltf.hpp"

namespace wilt::bench {
namespace {

void clip(benchmark::State& state) {
  const Maple maple(static_cast<int>(state.range(0)), "cell");
  for (auto _ : state)
    benchmark::DoNotOptimize(make_clip(maple.leaf, maple.venation, maple.config, maple.frames));
}
BENCHMARK(clip)->Arg(2000)->UseRealTime()->Unit(benchmark::kMillisecond);

void bytes(benchmark::State& state) {
  const Maple maple(static_cast<int>(state.range(0)), "cell");
  const Clip made = make_clip(maple.leaf, maple.venation, maple.config, maple.frames);
  std::size_t size = 0;
  for (auto _ : state) size = glb_bytes(made).size();
  state.counters["megabytes"] = 1e-6 * static_cast<double>(size);
}
BENCHMARK(bytes)->Arg(2000)->Arg(100000)->UseRealTime()->Unit(benchmark::kMillisecond);

void file(benchmark::State& state) {
  std::string path = std::filesystem::temp_directory_path() / "wilt-bench-";
  path += std::to_string(getpid());
  const std::string content(static_cast<std::size_t>(state.range(0)), 'x');
  for (auto _ : state) write_file(path, content);
  std::filesystem::remove(path);
}
BENCHMARK(file)->Arg(10000000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
