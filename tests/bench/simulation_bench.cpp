// Simulation against proof: how many runs of the concrete machine fit in the time of a proof, and how much of the
// arguments that the contract allows they cover in steps of 1.
//
//     simulation_bench PROGRAM.nc...
#include "dialects/registry.h"
#include "findings/project/project.h"
#include "proof/prove/prove.h"
#include "proof/space/plain_space.h"
#include "rules/registry.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>

namespace {

using namespace feedhold;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

class Package {
public:
  explicit Package(std::unique_ptr<const Project> programs)
      : programs_(std::move(programs)), start_(*startOf(*programs_, std::nullopt)),
        contracts_(programs_->file(start_.file).contracts), contract_(*contracts_.of(start_.program)) {}

  double proofTime(std::size_t &obligations) const {
    const auto begin = Clock::now();
    prove::ProveOptions options;
    for (const auto &file : programs_->files)
      options.contractsOf.push_back(&file->contracts);
    obligations = prove::prove(*programs_->set, start_, &contracts_, options).obligations.size();
    return since(begin);
  }

  /// Runs, with the gouges looked for, until the time is up.
  std::size_t runsIn(double seconds) const {
    std::mt19937 random(1);
    const auto begin = Clock::now();
    std::size_t runs = 0;
    for (; since(begin) < seconds; ++runs)
      runOnce(random);
    return runs;
  }

  /// Arguments in steps of 1, counted; an argument without both bounds counts as one.  Bounds that depend on other
  /// arguments are taken where those are largest.
  double argumentsInSteps() const {
    double all = 1;
    RunOptions largest;
    for (const EntryValue &param : contract_.params)
      if (const auto range = rangeOf(param, largest)) {
        all *= std::max(0.0, std::floor(range->second - range->first)) + 1;
        largest.variables.set(param.variable, ConcreteValue::of(range->second));
      }
    return all;
  }

private:
  std::optional<std::pair<double, double>> rangeOf(const EntryValue &param, const RunOptions &run) const {
    const auto *range = std::get_if<Range>(&param.values);
    if (range == nullptr || !range->low || !range->high)
      return std::nullopt;
    const auto number = [&](ExpressionId expression) {
      return prove::numberOf(*programs_->set, start_, contracts_, run, expression);
    };
    return std::pair(number(*range->low), number(*range->high));
  }

  void runOnce(std::mt19937 &random) const {
    RunOptions options;
    for (const EntryValue &param : contract_.params) {
      const auto range = rangeOf(param, options);
      const double share = std::uniform_real_distribution<double>(0, 1)(random);
      const double value = range ? range->first + share * std::max(0.0, range->second - range->first) : 1;
      options.variables.set(param.variable, ConcreteValue::of(param.unit == Unit::Integer ? std::round(value) : value));
    }
    options.fuel = 1'000'000;
    options = prove::startedAsSaid(*programs_->set, start_, contracts_, std::move(options));
    const RunResult result = run(*programs_->set, start_, options);
    const geometry::PlainSpace space = prove::plainSpace(*programs_->set, start_, contracts_, options);
    for (std::size_t region = 0; region < space.keepIn.size(); ++region)
      geometry::deepestGouge(space, geometry::SpaceClaim::KeepIn, region, result.moves);
    for (std::size_t region = 0; region < space.keepOut.size(); ++region)
      geometry::deepestGouge(space, geometry::SpaceClaim::KeepOut, region, result.moves);
  }

  std::unique_ptr<const Project> programs_;
  Callee start_;
  const FileContracts &contracts_;
  const Contract &contract_;
};

} // namespace

int main(int count, char **arguments) {
  fmt::print("| program | claims | proof, s | runs in that time | arguments in steps of 1 | share of them |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    auto loaded = loadProject({.path = arguments[i], .control = {.dialect = "fanuc-30i"}}, {allDialects(), allRules()});
    if (!loaded) {
      fmt::print(stderr, "{}\n", loaded.error().message);
      return 2;
    }
    const Package package(loaded.take());
    std::size_t claims = 0;
    const double seconds = package.proofTime(claims);
    const std::size_t runs = package.runsIn(seconds);
    const double all = package.argumentsInSteps();
    fmt::print("| `{}` | {} | {:.2f} | {} | {:.2g} | {:.1g} |\n", std::filesystem::path(arguments[i]).stem().string(),
               claims, seconds, runs, all, static_cast<double>(runs) / all);
  }
}
