// Writes to the standard streams.
#include "surface/cli/terminal.h"

#include "surface/cli/platform.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace feedhold {

namespace {

void writeTo(std::FILE *stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

} // namespace

ColourOption colourOptionFrom(std::string_view name) {
  return name == "always" ? ColourOption::Always : name == "never" ? ColourOption::Never : ColourOption::Auto;
}

bool useColour(ColourOption options) {
  switch (options) {
  case ColourOption::Always: return true;
  case ColourOption::Never: return false;
  case ColourOption::Auto: break;
  }
  const char *noColour = std::getenv("NO_COLOR");
  return (noColour == nullptr || *noColour == '\0') && isTerminal(Stream::Output);
}

bool isErrorTerminal() { return isTerminal(Stream::Error); }

void print(std::string_view text) { writeTo(stdout, text); }

void printError(std::string_view message) { writeTo(stderr, "feedhold: error: " + std::string(message) + "\n"); }

void printAside(std::string_view text) {
  std::fflush(stdout); // both may go to one place
  writeTo(stderr, text);
}

bool outputArrived() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

std::string readStandardInput() {
  std::string text;
  char buffer[64 * 1024];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, stdin)) > 0;)
    text.append(buffer, got);
  return text;
}

ProgressLine::ProgressLine() : isOn_(isErrorTerminal()) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(std::size_t done, std::size_t all) {
  if (!isOn_ || all < 2)
    return;
  const std::size_t percent = done * 100 / all;
  const std::lock_guard lock(mutex_);
  if (percent == shownPercent_)
    return;
  shownPercent_ = percent;
  printAside("\r\x1b[Kchecked " + std::to_string(done) + " of " + std::to_string(all) + " files");
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (isOn_ && shownPercent_ <= 100)
    printAside("\r\x1b[K");
  shownPercent_ = 101;
}

} // namespace feedhold
