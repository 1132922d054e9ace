// Which formats there are.
#include "surface/sink/sink.h"

#include <array>

namespace feedhold {

namespace {

constexpr std::array kFormats = {Format::Text,  Format::Concise, Format::Json,
                                 Format::Sarif, Format::Junit,   Format::Github};

} // namespace

std::string_view nameOf(Format format) {
  switch (format) {
  case Format::Text: return "text";
  case Format::Concise: return "concise";
  case Format::Json: return "json";
  case Format::Sarif: return "sarif";
  case Format::Junit: return "junit";
  case Format::Github: return "github";
  }
  FEEDHOLD_UNREACHABLE("a format without a name");
}

std::optional<Format> formatFromName(std::string_view name) {
  for (const Format format : kFormats)
    if (nameOf(format) == name)
      return format;
  return std::nullopt;
}

std::string write(Format format, const Report &report) {
  switch (format) {
  case Format::Text: return writeText(report);
  case Format::Concise: return writeConcise(report);
  case Format::Json: return writeJson(report);
  case Format::Sarif: return writeSarif(report);
  case Format::Junit: return writeJunit(report);
  case Format::Github: return writeGithub(report);
  }
  FEEDHOLD_UNREACHABLE("a format without a writer");
}

} // namespace feedhold
