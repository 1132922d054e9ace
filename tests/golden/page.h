// Page: a Markdown file whose headings are test cases.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace feedhold::golden {

/// A fenced block: "```nc fanuc-30i" .. "```".
struct Fence {
  std::string info;      // what follows the opening backquotes
  std::string text;      // the lines between, each with its line feed
  std::size_t firstLine; // 0-based index of the first line between, in Page::lines
  std::size_t lineCount;
};

/// A heading below the title and what stands under it.
struct Section {
  std::string title;
  std::size_t line; // 1-based
  std::vector<Fence> fences;
};

struct Page {
  std::string path;
  std::vector<std::string> lines; // without line feeds
  std::string title;              // of the `#` heading
  std::string lead;               // the first paragraph, its lines joined by spaces
  std::vector<Section> sections;
};

Page parsePage(std::string path, std::string_view text);

/// The text of the page with other bodies for some of its fences, which are named by Fence::firstLine, in order.
struct NewBody {
  std::size_t firstLine;
  std::size_t lineCount;
  std::string text;
};
std::string withBodies(const Page &page, const std::vector<NewBody> &bodies);

} // namespace feedhold::golden
