// Speed of the engine's stages in lines (items) and bytes a second, and memory of the tree, on a million lines.
#include "bench/generate.h"
#include "dialects/registry.h"
#include "findings/rule/run_rules.h"
#include "language/lex/lexer.h"
#include "language/parse/parse.h"
#include "rules/registry.h"

#include <benchmark/benchmark.h>

namespace feedhold::bench {
namespace {

constexpr std::size_t kLines = 1'000'000;

const SourceFile &input(InputKind kind) {
  static const SourceFile plain = SourceFile::fromText("plain.nc", generate(InputKind::Plain, kLines));
  static const SourceFile macro = SourceFile::fromText("macro.nc", generate(InputKind::Macro, kLines));
  return kind == InputKind::Plain ? plain : macro;
}

const Dialect &dialect() { return *allDialects().dialects.front(); }

void countThroughput(benchmark::State &state, const SourceFile &source) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * source.lineCount()));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * source.text().size()));
}

void lexing(benchmark::State &state, InputKind kind) {
  const SourceFile &source = input(kind);
  for (auto _ : state) {
    Lexer lexer(source.text(), dialect().grammar);
    std::size_t tokens = 0;
    while (lexer.next().kind != TokenKind::EndOfFile)
      ++tokens;
    benchmark::DoNotOptimize(tokens);
  }
  countThroughput(state, source);
}

void lexingAndParsing(benchmark::State &state, InputKind kind) {
  const SourceFile &source = input(kind);
  double bytesPerWord = 0;
  for (auto _ : state) {
    const SyntaxTree tree = parse(source, dialect());
    bytesPerWord = static_cast<double>(tree.bytes()) / static_cast<double>(tree.words.size());
    benchmark::DoNotOptimize(bytesPerWord);
  }
  countThroughput(state, source);
  state.counters["tree_bytes_per_word"] = bytesPerWord;
}

void resolving(benchmark::State &state, InputKind kind) {
  const SourceFile &source = input(kind);
  const SyntaxTree tree = parse(source, dialect());
  for (auto _ : state)
    benchmark::DoNotOptimize(resolve(source, tree, dialect()).programs.size());
  countThroughput(state, source);
}

/// Everything that `check` does with the text of one file, on one thread.
void checking(benchmark::State &state, InputKind kind) {
  const SourceFile &source = input(kind);
  std::vector<const Rule *> rules;
  for (const RegisteredRule &registered : allRules().rules)
    rules.push_back(registered.rule);
  std::size_t findings = 0;
  for (auto _ : state) {
    const SyntaxTree tree = parse(source, dialect());
    const ProgramModel model = resolve(source, tree, dialect());
    const CallGraph graph({{FileId(0), "", "bench", &model}});
    const ProgramSet programs({{FileId(0), &source, &tree, &model, &dialect()}}, graph);
    findings = runRules(rules, {FileId(0), source, dialect(), tree, model, graph, &programs}).size();
  }
  countThroughput(state, source);
  state.counters["findings"] = static_cast<double>(findings);
}

/// Graph and analysis of all programs of a file, on one thread.
void analysing(benchmark::State &state, InputKind kind) {
  const SourceFile &source = input(kind);
  const SyntaxTree tree = parse(source, dialect());
  const ProgramModel model = resolve(source, tree, dialect());
  const CallGraph graph({{FileId(0), "", "bench", &model}});
  std::size_t incomplete = 0;
  for (auto _ : state) {
    incomplete = 0;
    const ProgramSet programs({{FileId(0), &source, &tree, &model, &dialect()}}, graph);
    for (std::size_t i = 0; i < model.programs.size(); ++i)
      incomplete += collectFacts(programs, FileId(0), ProgramId(i), {}).isComplete() ? 0 : 1;
  }
  countThroughput(state, source);
  state.counters["incomplete"] = static_cast<double>(incomplete);
}

#define FEEDHOLD_BENCH(stage)                                                                                          \
  BENCHMARK_CAPTURE(stage, plain, InputKind::Plain)->Unit(benchmark::kMillisecond);                                    \
  BENCHMARK_CAPTURE(stage, macro, InputKind::Macro)->Unit(benchmark::kMillisecond)
FEEDHOLD_BENCH(lexing);
FEEDHOLD_BENCH(lexingAndParsing);
FEEDHOLD_BENCH(resolving);
FEEDHOLD_BENCH(checking);
FEEDHOLD_BENCH(analysing);

} // namespace
} // namespace feedhold::bench

BENCHMARK_MAIN();
