// Assembling the picture of a diagnostic, in the manner of rustc: head, places, source lines with labels, notes, fixes.
#include "base/diag/render.h"

#include "base/diag/line_picture.h"
#include "base/diag/marker_rows.h"
#include "base/diag/paint.h"
#include "base/support/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace feedhold {

namespace {

struct Mark {
  Span span;
  MarkerKind kind;
  std::string_view text;
};

/// What is shown of one file: marks by line.
struct Section {
  const SourceFile *source;
  std::uint32_t firstMark; // the place named above the lines
  std::map<std::uint32_t, std::vector<Mark>> lines;
};

void addMark(Section &section, const Mark &mark) {
  const auto size = static_cast<std::uint32_t>(section.source->text().size());
  const Span span = {std::min(mark.span.begin, size), std::min(mark.span.end, size)};
  section.lines[section.source->lineOf(span.begin)].push_back({span, mark.kind, mark.text});
}

std::vector<Section> sectionsOf(const Diagnostic &diagnostic, const SourceFile &source,
                                const std::function<const SourceFile &(FileId)> &fileOf) {
  std::vector<Section> sections = {{&source, diagnostic.span.begin, {}}};
  addMark(sections.front(), {diagnostic.span, MarkerKind::Primary, diagnostic.label});
  for (const Label &label : diagnostic.labels) {
    const SourceFile &file = label.file ? fileOf(*label.file) : source;
    auto section = std::ranges::find(sections, file.path(), [](const Section &s) { return s.source->path(); });
    if (section == sections.end())
      section = sections.insert(sections.end(), {&file, label.span.begin, {}});
    addMark(*section, {label.span, MarkerKind::Secondary, label.text});
  }
  return sections;
}

constexpr std::size_t kMostOfBlock = 40; // characters of a block that is named in a path

/// One line for each place that leads to the finding: its number, what stands there, what happened.
std::string pathText(const Diagnostic &diagnostic, const SourceFile &source,
                     const std::function<const SourceFile &(FileId)> &fileOf) {
  std::string text;
  for (const Label &step : diagnostic.flow) {
    const SourceFile &file = step.file ? fileOf(*step.file) : source;
    const Position begin = file.position(step.span.begin);
    const Position end = file.position(step.span.end);
    const bool isShort = begin.line == end.line && end.column - begin.column <= kMostOfBlock;
    const std::string block = isShort ? fmt::format(" `{}`", file.utf8(step.span)) : std::string();
    const std::string name = step.file && file.path() != source.path() ? std::string(file.path()) + " " : std::string();
    text += fmt::format("{}{}line {}{}: {}", text.empty() ? "" : "\n", name, begin.line, block, step.text);
  }
  return text;
}

std::string_view shownName(FixSafety safety) {
  switch (safety) {
  case FixSafety::Safe: return "safe";
  case FixSafety::NeedsReview: return "needs review";
  }
  FEEDHOLD_UNREACHABLE("a fix safety without a name");
}

class Renderer {
public:
  Renderer(const RenderedHead &head, const RenderOptions &options, std::vector<Section> sections)
      : head_(head), options_(options), painter_(head.severity, options.colour), sections_(std::move(sections)) {
    for (const Section &section : sections_)
      gutter_ = std::max(gutter_, std::to_string(section.lines.rbegin()->first).size());
  }

  std::string render(const Diagnostic &diagnostic, std::string_view path) {
    line({{std::string(head_.severity), Style::Severity},
          {": " + printable(diagnostic.message), Style::Message},
          {fmt::format(" [{}]", head_.rule)}});
    for (const Section &section : sections_)
      addSection(section);
    if (!path.empty() || !diagnostic.notes.empty() || !diagnostic.fixes.empty())
      gutterLine("", {});
    if (!path.empty())
      addNote("path", path);
    for (const std::string &note : diagnostic.notes)
      addNote("note", note);
    for (const FixIt &fix : diagnostic.fixes)
      addNote(fmt::format("fix ({})", shownName(fix.safety)), fix.title);
    return std::move(text_);
  }

private:
  void line(const StyledLine &pieces) { text_ += painter_.line(pieces); }

  void gutterLine(std::string_view number, const StyledLine &rest) {
    StyledLine pieces = {{fmt::format("{:>{}} |", number, gutter_), Style::Gutter}, {" "}};
    pieces.insert(pieces.end(), rest.begin(), rest.end());
    line(pieces);
  }

  void addSection(const Section &section) {
    const bool first = &section == &sections_.front();
    if (!first)
      gutterLine("", {});
    const Position place = section.source->position(section.firstMark);
    line({{std::string(gutter_, ' ') + (first ? "-->" : ":::"), Style::Gutter},
          {fmt::format(" {}:{}:{}", printable(section.source->path()), place.line, place.column)}});
    gutterLine("", {});
    std::uint32_t previous = section.lines.begin()->first;
    for (const auto &[number, marks] : section.lines) {
      if (number > previous + 1)
        line({{"...", Style::Gutter}});
      addSourceLine(*section.source, number, marks);
      previous = number;
    }
  }

  void addSourceLine(const SourceFile &source, std::uint32_t number, const std::vector<Mark> &marks) {
    std::vector<Span> spans;
    for (const Mark &mark : marks)
      spans.push_back(mark.span);
    const LinePicture picture(source, number, spans, {options_.tabWidth, options_.maxLineWidth});
    std::vector<Marker> markers;
    for (const Mark &mark : marks)
      markers.push_back({picture.columnsOf(mark.span), mark.kind, printable(mark.text)});
    gutterLine(std::to_string(number), {{picture.text()}});
    for (const StyledLine &row : markerRows(std::move(markers)))
      gutterLine("", row);
  }

  /// Further lines of a note stand below its first word.
  void addNote(std::string_view kind, std::string_view text) {
    const std::string lead(gutter_ + 1, ' ');
    const std::string name = fmt::format("{}: ", kind);
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string part = printable(text.substr(begin, end - begin));
      if (begin == 0)
        line({{lead + "= ", Style::Gutter}, {name, Style::Message}, {part}});
      else
        line({{std::string(lead.size() + 2 + name.size(), ' ')}, {part}});
      begin = end + 1;
    }
  }

  const RenderedHead &head_;
  const RenderOptions &options_;
  Painter painter_;
  std::vector<Section> sections_;
  std::size_t gutter_ = 1;
  std::string text_;
};

} // namespace

std::string render(const Diagnostic &diagnostic, const RenderedHead &head, const SourceFile &source,
                   const std::function<const SourceFile &(FileId)> &fileOf, const RenderOptions &options) {
  return Renderer(head, options, sectionsOf(diagnostic, source, fileOf))
      .render(diagnostic, pathText(diagnostic, source, fileOf));
}

} // namespace feedhold
