// wilt batch: many leaves by a plan.
#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "checks.hpp"
#include "interrupts.hpp"
#include "plan.hpp"
#include "verbs.hpp"
#include "wilt/batch/batch.hpp"
#include "wilt/batch/worker_processes.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kTries = 3;  // items that --dry-run makes

struct Request {
  std::string plan, folder, shard = "1/1";
  int jobs = 0;
  bool dry_run = false, retry = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What a child answers: the state of its item, or the code and message of an error that ends the batch.
std::string answer_of(Batch& batch, int item, const Monitor& monitor) {
  try {
    return batch.make(item, monitor) == ItemState::whole ? "whole" : "failed";
  } catch (const Error& error) {
    return fmt::format("{} {}", static_cast<int>(error.code()), error.what());
  }
}

struct Tally {
  int there = 0, made = 0, failed = 0;
  std::optional<Error> ended;  // what keeps the rest from being made
};

/// Makes the items and counts; messages about failures go to the terminal.
class Making {
 public:
  Making(Batch& batch, Terminal& terminal, int items) : batch_(batch), terminal_(terminal), items_(items) {}

  void take(const WorkReport& report) {
    if (!report.death.empty()) {
      batch_.record_failure(report.piece, ErrorCode::simulation, report.death + ", twice");
      count_failure(report.piece);
    } else if (report.answer == "failed") {
      count_failure(report.piece);
    } else if (report.answer == "whole") {
      ++tally.made;
    } else if (!tally.ended) {  // others then say that they were interrupted
      const std::size_t space = report.answer.find(' ');
      tally.ended = Error(static_cast<ErrorCode>(std::stoi(report.answer)), report.answer.substr(space + 1));
    }
    terminal_.count("items", tally.made + tally.failed, items_);
  }

  Tally tally;

 private:
  void count_failure(int item) {
    ++tally.failed;
    terminal_.warn(fmt::format("item {}: {}", item, batch_.failure(item)));
  }

  Batch& batch_;
  Terminal& terminal_;
  int items_;
};

std::vector<int> missing_items(Batch& batch, const Request& request, Tally& tally) {
  const Shard shard = parse_shard(request.shard);
  std::vector<int> missing;
  for (int item = 0; item < batch.plan().count(); ++item) {
    if (!shard.has(item)) continue;
    const ItemState state = batch.state(item);
    if (state == ItemState::whole) {
      ++tally.there;
    } else if (state == ItemState::missing || request.retry) {
      missing.push_back(item);
    } else {
      ++tally.failed;
    }
  }
  return missing;
}

int cores() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int processes_for(const Request& request) {
  return request.jobs > 0 ? request.jobs : cores();
}

Tally make_items(Batch& batch, const Request& request, Terminal& terminal) {
  Tally before;
  const std::vector<int> missing = missing_items(batch, request, before);
  for (const int item : missing) batch.forget_failure(item);  // of those that are to be tried again
  const int processes = processes_for(request);
  Making making(batch, terminal, static_cast<int>(missing.size()));
  Monitor monitor = terminal.monitor();
  monitor.cancelled = [&making] { return interrupted() || making.tally.ended.has_value(); };
  work_in_processes(
      missing, processes,
      [&](int item, const Monitor& child) {
        const ThreadLimit limit(std::max(1, cores() / processes));
        return answer_of(batch, item, child);
      },
      [&](const WorkReport& report) { making.take(report); }, monitor);
  Tally tally = making.tally;
  tally.there = before.there;
  tally.failed += before.failed;
  return tally;
}

void report(const Batch& batch, const Tally& tally, bool finished, double seconds, const Request& request,
            const GlobalOptions& options, Terminal& terminal) {
  terminal.say(fmt::format("{} items made, {} were there, {} failed; {:.0f} s", tally.made, tally.there,
                           tally.failed, seconds));
  terminal.say(finished ? fmt::format("all {} items are there: {}/manifest.jsonl", batch.plan().count(),
                                      request.folder)
                        : "the manifest is written by the run that makes the last item");
  if (!options.json) return;
  const nlohmann::ordered_json json = {{"items", batch.plan().count()}, {"made", tally.made},
                                       {"there", tally.there},          {"failed", tally.failed},
                                       {"finished", finished},          {"seconds", seconds}};
  print_data(json.dump(2) + "\n");
}

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

/// A folder for things of the moment.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "wilt-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw Error(ErrorCode::output, fmt::format("cannot write into '{}': {}; set TMPDIR to another folder",
                                                 fs::temp_directory_path().string(), std::strerror(errno)));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// --dry-run: makes a few of the items elsewhere, for their time and size.
void estimate(const Plan& plan, const Request& request, const GlobalOptions& options, Terminal& terminal) {
  Tally before;
  std::vector<int> missing;
  if (fs::exists(fs::path(request.folder) / "items")) {
    Batch batch(plan, request.folder);
    missing = missing_items(batch, request, before);
  } else {
    const Shard shard = parse_shard(request.shard);
    for (int item = 0; item < plan.count(); ++item)
      if (shard.has(item)) missing.push_back(item);
  }
  Monitor quiet = terminal.monitor();
  quiet.note = nullptr;
  const TemporaryFolder elsewhere;
  Batch trial(plan, elsewhere.path());
  const ThreadLimit one_core(1);
  const int tries = std::min<int>(kTries, static_cast<int>(missing.size()));
  int made = 0;
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < tries; ++k) {
    const int item = missing[missing.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(tries)];
    if (trial.make(item, quiet) == ItemState::whole) {
      ++made;
    } else {
      terminal.warn(fmt::format("item {}: {}", item, trial.failure(item)));
    }
  }
  const double seconds = made > 0 ? seconds_since(start) / made * double(missing.size()) : 0.0;
  const double copies = plan.outputs().webdataset ? 2.0 : 1.0;
  const double bytes =
      made > 0 ? double(bytes_in(elsewhere.path())) / made * double(missing.size()) * copies : 0.0;
  const nlohmann::ordered_json json = {{"items", plan.count()},   {"there", before.there},
                                       {"failed", before.failed}, {"to_make", missing.size()},
                                       {"core_seconds", seconds}, {"bytes", bytes}};
  print_data(options.json ? json.dump(2) + "\n"
                          : fmt::format("would make {} of {} items in {}: about {:.3g} core hours ({:.3g} "
                                        "hours in {} processes), {:.3g} GB; {} are there, {} have failed\n",
                                        missing.size(), plan.count(), request.folder, seconds / 3600.0,
                                        seconds / 3600.0 / processes_for(request), processes_for(request),
                                        bytes / 1e9, before.there, before.failed));
}

void run(const Request& request, const GlobalOptions& options) {
  const Plan plan = read_plan(request.plan);
  parse_shard(request.shard);
  Terminal terminal(options);
  if (request.dry_run) return estimate(plan, request, options, terminal);
  const Clock::time_point start = Clock::now();
  ask_on_interrupt();
  Batch batch(plan, request.folder);
  const Tally tally = make_items(batch, request, terminal);
  if (interrupted())
    throw Error(
        ErrorCode::interrupted,
        fmt::format("interrupted; {} items are whole, the same command goes on", tally.made + tally.there));
  if (tally.ended) throw *tally.ended;
  const bool finished = batch.finish(terminal.monitor());
  report(batch, tally, finished, seconds_since(start), request, options, terminal);
  if (tally.failed > 0)
    throw Error(ErrorCode::simulation,
                fmt::format("{} items could not be made; {}/failed says why, --retry tries them again",
                            tally.failed, request.folder));
}

}  // namespace

void add_batch(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("batch",
                         "Many leaves by a plan, in parallel; safe to stop and to run again\n\n"
                         "Examples:\n"
                         "  wilt batch plan.toml -o leaves --dry-run    how many, how long, how large\n"
                         "  wilt batch plan.toml -o leaves\n"
                         "  wilt batch plan.toml -o leaves --shard 3/50    on the third of 50 machines\n"
                         "\n"
                         "A plan:\n"
                         "  count = 1000\n"
                         "  leaf = {choice = [\"maple\", \"photos/*.jpg\"]}\n"
                         "  [settings]\n"
                         "  water.humidity = {uniform = [0.2, 0.9]}\n"
                         "  [write]\n"
                         "  files = [\"leaf.glb\"]\n"
                         "  [pictures]\n"
                         "  maps = [\"leaf\", \"vein\", \"depth\"]\n");
  verb->add_option("PLAN", request->plan, "A plan (.toml): docs/batches.md")->required()->type_name("FILE");
  verb->add_option("-o,--output", request->folder, "Folder of the batch; what is whole there is kept")
      ->required()
      ->type_name("DIR");
  verb->add_option("--shard", request->shard, "Only the i-th of N parts of the items (1/1)")
      ->type_name("i/N");
  verb->add_option("--jobs", request->jobs, "Items at a time, each in a process (all cores)")
      ->check(whole_number(1, 1024))
      ->type_name("N");
  verb->add_flag("--retry", request->retry, "Try again what has failed before");
  add_dry_run(*verb, request->dry_run);
  verb->callback([request, &options] { run(*request, options); });
}

}  // namespace wilt::cli
