// The stages of golden cases, each by the engine's own function.
#include "golden/stages.h"

#include "language/lex/lexer.h"
#include "language/model/model.h"
#include "language/parse/parse.h"

#include <fmt/format.h>

namespace feedhold::golden {

namespace {

std::string tokens(const SourceFile &source, const Dialect &) {
  std::string text;
  for (const Token &token : lex(source))
    text += fmt::format("{:<14}`{}`{}\n", nameOf(token.kind), source.utf8(token.span()),
                        token.abbreviated ? " abbreviated" : "");
  return text;
}

std::string tree(const SourceFile &source, const Dialect &dialect) {
  return dump(parse(source, dialect), source);
}

std::string model(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree tree = parse(source, dialect);
  return dump(resolve(source, tree, dialect), tree, source);
}

/// A dump for each file, under the file's name when there are several.
std::string dumps(const Input &input, std::string (*dumpOne)(const SourceFile &, const Dialect &)) {
  std::string text;
  for (const InputFile &file : input.files) {
    if (input.files.size() > 1)
      text += fmt::format("== {} ==\n", file.name);
    text += dumpOne(SourceFile::fromText(file.name, file.text), *file.dialect);
  }
  return text;
}

} // namespace

std::optional<std::string> runStage(std::string_view stage, const Input &input) {
  if (stage == "tokens")
    return dumps(input, tokens);
  if (stage == "tree")
    return dumps(input, tree);
  if (stage == "model")
    return dumps(input, model);
  return std::nullopt;
}

} // namespace feedhold::golden
