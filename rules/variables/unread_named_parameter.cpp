// unread-named-parameter: `#<peck> = #5` in a subroutine, and no other `#<peck>` in the file.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace feedhold::rules::unread_named_parameter {
namespace {

/// Above it the names are a list of settings that several programs share, and one finding names them all.
constexpr std::size_t kMostTold = 4;

/// Case and blanks do not count.
std::string canonical(std::string_view text) {
  std::string name;
  for (const char c : text)
    if (!isBlank(c))
      name.push_back(toUpper(c));
  return name;
}

/// `<NAME>` wherever it stands, in remarks too: `(DEBUG, #<name>)` reads it.
std::map<std::string, int> namesIn(std::string_view text) {
  std::map<std::string, int> names;
  for (std::size_t at = text.find("#<"); at != std::string_view::npos; at = text.find("#<", at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end != std::string_view::npos && end < text.find('\n', at))
      ++names[canonical(text.substr(at, end - at + 1))];
  }
  return names;
}

struct Unread {
  std::string name;
  Span place;
  bool isCopy; // `#<depth> = #3`, `#<len> = #<_line:len>`: one name of several that were passed or returned
};

/// `#<_z>`: a position, which somebody wanted to remember.
bool isPosition(const VariableUse &use, const FileContext &context) {
  constexpr std::size_t kLetter = 5; // `#<_x>`
  const std::string name = canonical(context.text(context.tree.expressions[use.expression].span));
  return name.starts_with("#<_") && name.size() == kLetter;
}

/// The block does nothing but give another variable a name; a system variable is a measured value.
bool isCopy(const VariableUse &use, const FileContext &context) {
  constexpr std::uint32_t kLastArgument = 30;
  const auto uses = context.model.variablesIn(use.block, use.block.next());
  const auto isOther = [&](const VariableUse &other) { return other.expression != use.expression; };
  return std::ranges::count_if(uses, isOther) == 1 && std::ranges::all_of(uses, [&](const VariableUse &other) {
           const bool isNamed = as<NamedVariable>(context.tree, other.expression) != nullptr;
           return !isOther(other) || (!other.write && !isPosition(other, context) &&
                                      (isNamed || (other.number && *other.number <= kLastArgument)));
         });
}

/// Magic parameters of QtPlasmaC, which its filter reads out of the text (its manual, "G-Code").
bool isMagic(std::string_view name) {
  constexpr std::array kMagic = {"#<HOLES>",       "#<H_DIAMETER>", "#<H_VELOCITY>",    "#<I_DIAMETER>", "#<OCLENGTH>",
                                 "#<PIERCE-ONLY>", "#<TUBE-CUT>",   "#<KEEP-Z-MOTION>", "#<M190>"};
  return std::ranges::find(kMagic, name) != kMagic.end();
}

std::vector<Unread> unreadIn(const FileContext &context) {
  std::map<std::string, int> found = namesIn(context.source.text());
  std::vector<Unread> unread;
  std::set<std::string> told;
  for (const VariableUse &use : context.model.variables)
    if (as<NamedVariable>(context.tree, use.expression) && use.write)
      --found[canonical(context.text(context.tree.expressions[use.expression].span))];
  for (const VariableUse &use : context.model.variables) {
    if (!as<NamedVariable>(context.tree, use.expression) || !use.write)
      continue;
    const Span place = context.tree.expressions[use.expression].span;
    const std::string name = canonical(context.text(place));
    // With `_` in front it is global: other programs, or the screen of the control, may read it.
    if (!name.starts_with("#<_") && !isMagic(name) && found[name] == 0 && told.insert(name).second)
      unread.push_back({name, place, isCopy(use, context)});
  }
  return unread;
}

void check(const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.namedParameters)
    return;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i)
    if (context.tree.blocks[BlockId(i)].has(Block::kBroken))
      return; // which may read any of them
  const std::vector<Unread> unread = unreadIn(context);
  for (const Unread &each : unread) {
    Diagnostic diagnostic{.message = fmt::format("{} is set but never read", context.quoted(each.place)),
                          .span = each.place,
                          .notes = {"a name without `_` in front is known only to the program that sets it: the value "
                                    "has no effect",
                                    "use it where it was meant, or delete the assignment"}};
    if (unread.size() > kMostTold) {
      std::string others;
      for (const Unread &other : unread)
        if (&other != &each)
          others += (others.empty() ? "`" : ", `") + toLower(other.name) + "`";
      diagnostic.notes.push_back("neither are " + others);
    }
    reporter.report(std::move(diagnostic), each.isCopy ? Severity::Info : Severity::Warning);
    if (unread.size() > kMostTold)
      return;
  }
}

} // namespace

extern const Rule unreadNamedParameter;
const Rule unreadNamedParameter{.info = {"unread-named-parameter", Category::Variable, Severity::Warning,
                                         "Reports a local named parameter that is set and nowhere read."},
                                .hooks = {.file = check}};

} // namespace feedhold::rules::unread_named_parameter
