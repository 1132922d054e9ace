// `feedhold tokens FILE`: what the lexer sees, a token a line: kind, bytes, text.
#include "language/lex/lexer.h"
#include "surface/cli/dump_input.h"

namespace feedhold {

namespace {

std::string dumpTokens(const SourceFile &source, const Dialect &dialect) { return dump(lex(source, dialect), source); }

} // namespace

Command addTokensCommand(CLI::App &parent) {
  return addDumpCommand(parent, "tokens", "print the tokens of a program", dumpTokens);
}

} // namespace feedhold
