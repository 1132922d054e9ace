// What may be written next.
#include "base/source/path_text.h"
#include "base/support/text.h"
#include "surface/lsp/feature_arguments.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::lsp {

namespace {

enum ItemKind : int { kFunction = 3, kField = 5, kVariable = 6, kKeyword = 14, kReference = 18, kConstant = 21 };

/// From its first digit, blanks between them included.
std::uint32_t digitsAtEnd(std::string_view text) {
  const std::size_t before = text.find_last_not_of("0123456789 \t");
  const std::size_t first = text.find_first_of("0123456789", before == std::string_view::npos ? 0 : before + 1);
  return static_cast<std::uint32_t>(text.size() - std::min(first, text.size()));
}
std::uint32_t digitsAtBegin(std::string_view text) {
  return static_cast<std::uint32_t>(std::min(text.find_first_not_of("0123456789"), text.size()));
}
/// Without blanks, in capitals.
std::string dense(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (!isBlank(c))
      result += toUpper(c);
  return result;
}

class Completions {
public:
  Completions(const View &view, std::uint32_t offset) : view_(view), file_(view.file()), offset_(offset) {
    const Span line = file_.source.lineSpan(file_.source.lineOf(offset));
    line_ = file_.source.text(Span{line.begin, std::min(offset, line.end)});
    behind_ = file_.source.text(Span{std::min(offset, line.end), line.end});
    program_ = file_.model.programOf(file_.tree.blockAt(line.begin));
  }

  Json build() {
    if (const std::size_t open = line_.rfind('(');
        open != std::string_view::npos && line_.find(')', open) == std::string_view::npos)
      return clauses(trimmed(line_.substr(open + 1)));
    if (isInComment())
      return nullptr;
    prefix_ = digitsAtEnd(line_);
    suffix_ = digitsAtBegin(behind_);
    const std::string head = dense(line_.substr(0, line_.size() - prefix_));
    if (head.ends_with("GOTO") || head.ends_with("M99P") || head.ends_with("M97P"))
      return labels();
    if (head.ends_with('#'))
      return variables();
    if (head.ends_with('P') && callsByNumber(head))
      return programs();
    return arguments();
  }

private:
  static bool callsByNumber(std::string_view head) {
    constexpr std::array<std::string_view, 4> kCalls = {"G65", "G66", "M98", "M198"};
    return std::any_of(kCalls.begin(), kCalls.end(),
                       [&](std::string_view call) { return head.find(call) != std::string_view::npos; });
  }
  /// In one that goes on to the end of the line.
  bool isInComment() const {
    if (file_.tree.blockCount() == 0)
      return false;
    const auto comments = file_.tree.commentsOf(file_.tree.blockAt(offset_));
    return std::any_of(comments.begin(), comments.end(), [&](const Comment &comment) {
      return comment.span.begin < offset_ && offset_ <= comment.span.end && file_.source.text(comment.span)[0] == ';';
    });
  }
  /// Replaces `prefix_` bytes before the cursor and `suffix_` behind it.
  void add(const std::string &label, ItemKind kind, const std::string &detail, const std::string &documentation = {}) {
    Json item{{"label", label},
              {"kind", static_cast<int>(kind)},
              {"sortText", fmt::format("{:05}", items_.size())},
              {"textEdit",
               {{"range", rangeOf(view_, kDocument, Span{offset_ - prefix_, offset_ + suffix_})}, {"newText", label}}}};
    if (!detail.empty())
      item["detail"] = detail;
    if (!documentation.empty())
      item["documentation"] = markdown(documentation);
    items_.push_back(std::move(item));
  }

  Json clauses(std::string_view written) {
    if (!written.starts_with('@') || written.find_first_of(" \t") != std::string_view::npos)
      return nullptr;
    prefix_ = static_cast<std::uint32_t>(written.size());
    constexpr std::array kAll = {
#define CLAUSE(kind, name) ClauseKind::kind,
#include "language/contract/clauses.def"
    };
    for (const ClauseKind kind : kAll)
      add(std::string(feedhold::nameOf(kind)), kKeyword, std::string(helpOf(kind)));
    return std::move(items_);
  }
  Json labels() {
    std::set<std::uint32_t> seen;
    for (const SequenceNumber &each : file_.model.sequenceNumbersOf(program_))
      if (seen.insert(each.number).second)
        add(std::to_string(each.number), kReference, file_.source.utf8(file_.tree.blocks[each.block].span()));
    return std::move(items_);
  }
  Json programs() {
    for (std::size_t i = 0; i < view_.programs->files.size(); ++i) {
      const ProjectFile &file = *view_.programs->files[i];
      for (std::size_t p = 0; p < file.model.programs.size(); ++p) {
        const ProgramName &name = file.model.programs[ProgramId(p)].name;
        if (!name.number || (FileId(i) == kDocument && ProgramId(p) == program_))
          continue;
        const std::string title = titleOf(file, ProgramId(p));
        const std::string in = pathText(file.path.filename());
        add(std::to_string(*name.number), kFunction, title.empty() ? in : fmt::format("{} ({})", title, in));
      }
    }
    return std::move(items_);
  }
  Json variables() {
    prefix_ += 1; // the `#`
    std::set<std::uint32_t> seen;
    for (const VariableUse &use : file_.model.variablesOf(program_))
      if (use.number && seen.insert(*use.number).second)
        variable(*use.number, meaningOf(*view_.programs, {kDocument, program_}, *use.number));
    for (const VariableRange &range : view_.programs->dialect().variables)
      if (range.kind == VariableKind::System && seen.insert(range.first).second)
        variable(range.first, range.first == range.last ? "" : fmt::format("up to #{}", range.last));
    return std::move(items_);
  }
  void variable(std::uint32_t number, const std::string &meaning) {
    const std::string kind = kindOf(*view_.programs, number);
    add(fmt::format("#{}", number), kVariable, meaning.empty() ? kind : fmt::format("{}: {}", meaning, kind));
  }
  /// The letters that the called macro takes and the call does not pass yet.
  Json arguments() {
    const auto at = macroCallAt(*view_.programs, offset_);
    const bool startsWord =
        line_.empty() || isBlank(line_.back()) || isDigit(line_.back()) || line_.back() == '.' || line_.back() == ']';
    if (!at || !startsWord)
      return nullptr;
    prefix_ = suffix_ = 0;
    for (const Parameter &parameter : parametersOf(*view_.programs, at->callee)) {
      const bool isPassed = std::any_of(at->call->arguments.begin(), at->call->arguments.end(),
                                        [&](const Argument &each) { return each.variable == parameter.variable; });
      if (!isPassed)
        add(std::string(1, parameter.letter), kField,
            parameter.name.empty() ? fmt::format("#{}", parameter.variable)
                                   : fmt::format("{} (#{})", parameter.name, parameter.variable),
            parameter.clause.empty() ? "" : fmt::format("`{}`", parameter.clause));
    }
    return std::move(items_);
  }

  const View &view_;
  const ProjectFile &file_;
  std::uint32_t offset_;
  std::string_view line_;   // up to the cursor
  std::string_view behind_; // and from there
  ProgramId program_{0};
  std::uint32_t prefix_ = 0;
  std::uint32_t suffix_ = 0;
  Json items_ = Json::array();
};

} // namespace

Json completion(const View &view, const Json &params) { return Completions(view, offsetOf(view, params)).build(); }

} // namespace feedhold::lsp
