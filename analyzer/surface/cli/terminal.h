// Terminal: standard output and error, colours, and reading standard input.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace feedhold {

enum class ColourOption { Auto, Always, Never };

/// From `auto`, `always` or `never`.
ColourOption colourOptionFrom(std::string_view name);
/// Auto: standard output is a terminal and NO_COLOR is not set (no-color.org).
bool useColour(ColourOption options);
bool isErrorTerminal();

void print(std::string_view text);
/// `feedhold: error: ..` on standard error.
void printError(std::string_view message);
/// Plain text on standard error.
void printAside(std::string_view text);
/// All that was printed reached its place; false on a full disk.
bool outputArrived();

std::string readStandardInput();

/// One line on a terminal's standard error that is written over; nothing elsewhere.  May be called from any thread.
class ProgressLine {
public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine &) = delete;
  ProgressLine &operator=(const ProgressLine &) = delete;

  void show(std::size_t done, std::size_t all);
  void clear();

private:
  std::mutex mutex_;
  bool isOn_;
  std::size_t shownPercent_ = 101;
};

} // namespace feedhold
