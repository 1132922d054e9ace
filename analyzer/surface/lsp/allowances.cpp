#include "surface/lsp/allowances.h"

#include "base/source/path_text.h"
#include "base/support/text.h"
#include "findings/project/sidecars.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace fs = std::filesystem;

namespace {

/// The block at which the finding is; absent: it is of an older text.
std::optional<BlockId> blockOf(const PublishedDiagnostic &published, const ProjectFile &file) {
  if (published.span.begin > file.source.text().size())
    return std::nullopt;
  return file.tree.blockAt(published.span.begin);
}

/// Of the block, when it is the first one of that number in its program: a clause means that one.
std::optional<std::uint32_t> numberOf(BlockId block, const ProjectFile &file) {
  const Program &program = file.model.programs[file.model.programOf(block)];
  const auto numbers = file.model.sequenceNumbersIn(program.first, program.last);
  const auto own =
      std::find_if(numbers.begin(), numbers.end(), [&](const SequenceNumber &each) { return each.block == block; });
  if (own == numbers.end())
    return std::nullopt;
  const auto first = std::find_if(numbers.begin(), numbers.end(),
                                  [&](const SequenceNumber &each) { return each.number == own->number; });
  return first->block == block ? std::optional(own->number) : std::nullopt;
}

const SourceFile *sourceOf(const fs::path &sidecar, const ProjectFile &file) {
  const auto &sources = file.contracts.sources;
  const auto found = std::find_if(sources.begin(), sources.end(),
                                  [&](const SourceFile &source) { return fs::path(source.path()) == sidecar; });
  return found == sources.end() ? nullptr : &*found;
}

/// The file in which the program is meant without being named; absent: each of them means another one.
struct Home {
  fs::path file;
  const SourceFile *source; // null: it is not there yet
};
std::optional<Home> homeOf(ProgramId program, const ProjectFile &file) {
  const std::optional<std::uint32_t> number = file.model.programs[program].name.number;
  std::vector<fs::path> names;
  if (number)
    for (const char *form : {"O{:04}.contract", "O{}.contract"})
      names.push_back(file.path.parent_path() / fmt::format(fmt::runtime(form), *number));
  if (program == ProgramId(0))
    for (const fs::path &name : {file.path.stem(), file.path.filename()})
      names.push_back(file.path.parent_path() / (pathText(name) + ".contract"));
  for (const fs::path &name : names)
    if (const SourceFile *source = sourceOf(name, file))
      return Home{name, source};
  return names.empty() ? std::nullopt : std::optional(Home{names.front(), nullptr});
}

/// What a comment can stand behind: all of the block but its last blanks, and a comment that goes on to the end of the
/// line.
Span placeForComment(BlockId at, const ProjectFile &file) {
  const Block &block = file.tree.blocks[at];
  std::uint32_t end = block.end;
  for (const Comment &comment : file.tree.commentsOf(at))
    if (!comment.closed || file.source.text(comment.span).starts_with(';'))
      end = std::min(end, comment.span.begin);
  while (end > block.begin && isBlank(file.source.text()[end - 1]))
    --end;
  return {block.begin, end};
}

} // namespace

std::optional<Edit> commentAllowing(const PublishedDiagnostic &published, const ProjectFile &file) {
  const std::optional<BlockId> at = blockOf(published, file);
  if (!at)
    return std::nullopt;
  const Span place = placeForComment(*at, file);
  return Edit{{place.end, place.end}, fmt::format("{}(@ALLOW {} )", place.empty() ? "" : " ", published.code)};
}

std::optional<SidecarClause> clauseAllowing(const PublishedDiagnostic &published, const ProjectFile &file) {
  const std::optional<BlockId> block = blockOf(published, file);
  std::error_code ignored; // what cannot be asked has no files beside it
  if (!block || !fs::is_regular_file(file.path, ignored) || file.model.programs.empty())
    return std::nullopt;
  const ProgramId program = file.model.programOf(*block);
  const std::optional<Home> home = homeOf(program, file);
  if (!home)
    return std::nullopt;
  SidecarClause clause{.file = home->file,
                       .isNew = home->source == nullptr,
                       .before = home->source ? *home->source : SourceFile::fromText(pathText(home->file), ""),
                       .edit = {},
                       .place = {}};
  const std::optional<std::uint32_t> number = numberOf(*block, file);
  const std::string_view text = clause.before.text();
  const auto end = static_cast<std::uint32_t>(text.size());
  const bool isInLine = !text.empty() && text.back() != '\n' && text.back() != '\r';
  clause.place = number ? fmt::format("N{}", *number) : "the whole program";
  clause.edit = {{end, end},
                 fmt::format("{}@ALLOW {}{} \n", isInLine ? "\n" : "", published.code,
                             number ? fmt::format(" N{}", *number) : "")};
  return clause;
}

} // namespace feedhold::lsp
