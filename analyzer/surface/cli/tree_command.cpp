// `feedhold tree FILE`: the syntax tree as indented text.
#include "language/parse/parse.h"
#include "surface/cli/dump_input.h"

namespace feedhold {

namespace {

std::string dumpTree(const SourceFile &source, const Dialect &dialect) { return dump(parse(source, dialect), source); }

} // namespace

Command addTreeCommand(CLI::App &parent) {
  return addDumpCommand(parent, "tree", "print the syntax tree of a program", dumpTree);
}

} // namespace feedhold
