// The self-check: built-in programs with known answers, through every engine, as this build does it on this machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace feedhold {

struct SelfCheckStep {
  std::string name;
  std::string shown;                       // what it says of the installation
  std::optional<std::string> problem = {}; // absent: all is as it must be
  bool isPassedOver = false;               // a solver that is not installed
};

/// In order.  Reads and writes no files.
std::vector<SelfCheckStep> selfCheck();

} // namespace feedhold
