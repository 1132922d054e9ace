#include "findings/project/outcome.h"

#include "base/support/check.h"

namespace feedhold {

std::string_view nameOf(DialectChoice choice) {
  switch (choice) {
  case DialectChoice::Option: return "option";
  case DialectChoice::FilePattern: return "file-pattern";
  case DialectChoice::Config: return "config";
  case DialectChoice::Guess: return "guess";
  case DialectChoice::FolderVote: return "folder";
  case DialectChoice::Fallback: return "fallback";
  }
  FEEDHOLD_UNREACHABLE("a way to choose a dialect without a name");
}

std::string_view nameOf(SkipKind kind) {
  switch (kind) {
  case SkipKind::Refused: return "refused";
  case SkipKind::NoProgram: return "no-program";
  }
  FEEDHOLD_UNREACHABLE("a kind of skipped files without a name");
}

} // namespace feedhold
