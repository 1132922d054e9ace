// The scan of a whole text: what its name and its bytes say, then line by line.
#include "language/dialect/text_signals.h"

#include "base/support/text.h"
#include "language/dialect/line_signals.h"
#include "language/dialect/text_keywords.h"

#include <algorithm>
#include <string>
#include <utility>

namespace feedhold {
namespace {

/// Of a line of ten megabytes, the beginning says enough.
constexpr std::size_t kLongestLine = 512;

struct NamedSignal {
  std::string_view extension;
  TextSignal signal;
};

constexpr NamedSignal kExtensions[] = {
    {"mpf", TextSignal::SinumerikFile}, {"spf", TextSignal::SinumerikFile}, {"min", TextSignal::OkumaFileName},
    {"ssb", TextSignal::OkumaFileName}, {"eia", TextSignal::EiaFile},       {"ngc", TextSignal::NgcFile},
    {"macro", TextSignal::GrblFile},
};

/// Documents, source code, data, pictures, archives, and the tables and settings of controls and simulators.
constexpr std::string_view kOtherExtensions[] = {
    "md",     "markdown", "rst",   "adoc", "html",  "htm",  "xml",  "json",     "yaml", "yml", "toml",  "csv",
    "tsv",    "cpp",      "hpp",   "cc",   "cxx",   "c",    "hh",   "cs",       "java", "js",  "mjs",   "ts",
    "tsx",    "py",       "rb",    "rs",   "go",    "sh",   "bat",  "ps1",      "lua",  "pl",  "css",   "scss",
    "sql",    "ini",      "cmake", "log",  "sarif", "diff", "tex",  "svg",      "vue",  "php", "vb",    "bas",
    "pdf",    "doc",      "docx",  "xls",  "xlsx",  "ppt",  "pptx", "odt",      "ods",  "rtf", "png",   "jpg",
    "jpeg",   "gif",      "bmp",   "ico",  "tif",   "tiff", "zip",  "7z",       "gz",   "rar", "tar",   "exe",
    "dll",    "so",       "o",     "a",    "bin",   "stl",  "step", "stp",      "iges", "igs", "dxf",   "dwg",
    "sldprt", "f3d",      "hal",   "tbl",  "var",   "cfg",  "conf", "contract", "lock", "pyc", "class", "jar",
};

std::string extensionOf(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string() : toLower(name.substr(dot + 1));
}

/// Control characters outside line ends, tabs and the tape's own (NUL leader, DC1 to DC4, SUB at the end).
bool isBinaryText(std::string_view text) {
  std::size_t controls = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool isTape = byte == 0 || (byte >= 0x11 && byte <= 0x14) || byte == 0x1A || byte == 0x7F;
    controls += byte < 0x20 && !isTape && byte != '\t' && byte != '\n' && byte != '\r' && byte != '\f' ? 1U : 0U;
  }
  return controls * 50 > text.size(); // more than two in a hundred
}

bool beginsAsMarkup(std::string_view text) {
  constexpr std::string_view kBegins[] = {"<!", "<?", "<html", "<HTML", "#!", "#include", "{", "%PDF", "PK\x03\x04"};
  const std::string_view body = trimmed(text.substr(0, 64));
  return std::any_of(std::begin(kBegins), std::end(kBegins),
                     [body](std::string_view begin) { return body.substr(0, begin.size()) == begin; });
}

struct NamePart {
  std::string_view begin;
  TextSignal signal;
};

/// Words of a file name and of the folder that holds it.
constexpr NamePart kNameParts[] = {
    {"LATHE", TextSignal::LatheName},      {"TURN", TextSignal::LatheName},
    {"DREH", TextSignal::LatheName},       {"MILL", TextSignal::MillName},
    {"FRAES", TextSignal::MillName},       {"VMC", TextSignal::MillName},
    {"HMC", TextSignal::MillName},         {"FANUC", TextSignal::FanucName},
    {"HAAS", TextSignal::HaasName},        {"MITSUBISHI", TextSignal::MitsubishiName},
    {"MAZAK", TextSignal::MitsubishiName}, {"MELDAS", TextSignal::MitsubishiName},
};

void scanNameParts(std::string_view path, TextScan &scan) {
  std::size_t folder = path.find_last_of("/\\");
  folder = folder == std::string_view::npos || folder == 0 ? 0 : path.find_last_of("/\\", folder - 1);
  const std::string_view names = folder == std::string_view::npos ? path : path.substr(folder);
  bool isStart = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const NamePart &part : kNameParts)
      if (isStart && beginsUpper(names.substr(i), part.begin))
        scan.counts[static_cast<std::size_t>(part.signal)] = 1;
    isStart = !isLetter(names[i]);
  }
}

/// Programs that a control starts by their names.
constexpr std::string_view kDdcsFiles[] = {"SLIB-", "FNDZERO.NC", "EXTKEY"};

void scanName(std::string_view path, TextScan &scan) {
  scanNameParts(path, scan);
  const std::size_t slash = path.find_last_of("/\\");
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  for (const std::string_view begin : kDdcsFiles)
    if (beginsUpper(name, begin))
      scan.counts[static_cast<std::size_t>(TextSignal::DdcsFile)] = 1;
  const std::string extension = extensionOf(path);
  for (const NamedSignal &named : kExtensions)
    if (extension == named.extension)
      ++scan.counts[static_cast<std::size_t>(named.signal)];
  scan.isMarkup = namesOtherFormat(path);
}

} // namespace

bool namesOtherFormat(std::string_view path) {
  const std::string extension = extensionOf(path);
  return std::find(std::begin(kOtherExtensions), std::end(kOtherExtensions), extension) != std::end(kOtherExtensions);
}

std::string_view descriptionOf(TextSignal signal) {
  static constexpr std::string_view kDescriptions[] = {
#define SIGNAL(kind, description) description,
#include "language/dialect/text_signals.def"
  };
  return kDescriptions[static_cast<std::size_t>(signal)];
}

namespace {

/// A loop without a number is written by beginners of Macro B, too: it tells of C operators only beside one of them.
/// A loop with a number is Macro B where a condition is, too, however others are written.
void weighLoops(TextScan &scan) {
  if (scan.count(TextSignal::NumberedLoop) != 0 && scan.count(TextSignal::WordRelation) != 0)
    for (const TextSignal mark : {TextSignal::CLikeOperator, TextSignal::BareCondition})
      scan.counts[static_cast<std::size_t>(mark)] = 0;
  if (scan.count(TextSignal::CLikeOperator) == 0 && scan.count(TextSignal::BareCondition) == 0 &&
      scan.count(TextSignal::EdingStatement) == 0)
    scan.counts[static_cast<std::size_t>(TextSignal::LoneEndWhile)] = 0;
}

/// Shops call their Macro B `.macro`, too; printers, which have no names, take the P of `G38.2` for a number.
void weighMarksOfGrbl(TextScan &scan) {
  std::uint32_t &probes = scan.counts[static_cast<std::size_t>(TextSignal::PrinterProbe)];
  if (scan.count(TextSignal::OWord) == 0 && scan.count(TextSignal::AngleName) == 0)
    scan.counts[static_cast<std::size_t>(TextSignal::GrblFile)] = 0;
  else
    scan.counts[static_cast<std::size_t>(TextSignal::GrblProbe)] = std::exchange(probes, 0);
}

} // namespace

TextScan scanText(std::string_view text, std::string_view path) {
  TextScan scan;
  scanName(path, scan);
  if (text.substr(0, 3) == "\xEF\xBB\xBF")
    text.remove_prefix(3);
  scan.isBinary = isBinaryText(text);
  scan.isMarkup = scan.isMarkup || beginsAsMarkup(text);
  if (scan.isBinary || scan.isMarkup)
    return scan;
  const char *at = text.data();
  const char *const end = at + text.size();
  while (at != end) {
    const char *lineEnd = at;
    while (lineEnd != end && *lineEnd != '\n' && *lineEnd != '\r')
      ++lineEnd;
    const std::string_view line(at, static_cast<std::size_t>(lineEnd - at));
    if (line.substr(0, 3) == "```") {
      scan.isMarkup = true;
      return scan;
    }
    scanLine(line.substr(0, kLongestLine), scan);
    at = lineEnd == end ? end : lineEnd + 1;
  }
  weighLoops(scan);
  weighMarksOfGrbl(scan);
  return scan;
}

} // namespace feedhold
