// What the self-check of an installation says: a release report cites it as the qualification of the tool.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

struct SelfCheckStep {
  std::string name;
  std::string shown;                       // what it says of the installation
  std::optional<std::string> problem = {}; // absent: all is as it must be
  bool isPassedOver = false;               // a solver that is not installed

  const std::string &message() const { return problem ? *problem : shown; }
  std::string_view result() const { return problem ? "failed" : isPassedOver ? "skipped" : "passed"; }
};

inline bool passed(const std::vector<SelfCheckStep> &steps) {
  return std::ranges::none_of(steps, [](const SelfCheckStep &step) { return step.problem.has_value(); });
}

} // namespace feedhold
