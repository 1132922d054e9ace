// Reading and rewriting the Markdown that golden cases are made of: `#` headings and ``` fences, no more.
#include "golden/page.h"

namespace feedhold::golden {

namespace {

std::vector<std::string> splitLines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

bool isHeading(std::string_view line, std::string_view marks) {
  return line.starts_with(marks) && line.size() > marks.size() && line[marks.size()] == ' ';
}

/// The fence whose opening line is lines[open].
Fence readFence(const std::vector<std::string> &lines, std::size_t open) {
  Fence fence{lines[open].substr(3), {}, open + 1, 0};
  for (std::size_t at = open + 1; at < lines.size() && lines[at] != "```"; ++at) {
    fence.text += lines[at] + '\n';
    ++fence.lineCount;
  }
  return fence;
}

} // namespace

Page parsePage(std::string path, std::string_view text) {
  Page page{std::move(path), splitLines(text), {}, {}, {}};
  bool leadEnded = false;
  for (std::size_t at = 0; at < page.lines.size(); ++at) {
    const std::string &line = page.lines[at];
    if (isHeading(line, "#")) {
      page.title = line.substr(2);
    } else if (isHeading(line, "##")) {
      page.sections.push_back({line.substr(3), at + 1, {}});
    } else if (line.starts_with("```")) {
      Fence fence = readFence(page.lines, at);
      at = fence.firstLine + fence.lineCount;
      if (!page.sections.empty())
        page.sections.back().fences.push_back(std::move(fence));
    } else if (page.sections.empty() && !leadEnded && !page.title.empty()) {
      leadEnded = line.empty() && !page.lead.empty();
      page.lead += (page.lead.empty() || line.empty() ? "" : " ") + line;
    }
  }
  return page;
}

std::string withBodies(const Page &page, const std::vector<NewBody> &bodies) {
  std::string text;
  std::size_t at = 0;
  for (const NewBody &body : bodies) {
    for (; at < body.firstLine; ++at)
      text += page.lines[at] + '\n';
    text += body.text;
    at += body.lineCount;
  }
  for (; at < page.lines.size(); ++at)
    text += page.lines[at] + '\n';
  return text;
}

} // namespace feedhold::golden
