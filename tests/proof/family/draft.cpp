#include "proof/family/draft.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

constexpr int kTrials = 12;

double within(Draw &draw, const Argument &argument) {
  const auto steps = static_cast<std::uint32_t>((argument.high - argument.low) * 8) + 1;
  const double value = argument.low + draw.below(steps) / 8.0;
  return argument.kind == ArgumentKind::Whole ? std::floor(value) : value;
}

std::string clauseOf(const Argument &argument) {
  return fmt::format("(@{} #{} {}..{}{}{})\n", argument.variable < 100 ? "PARAM" : "GLOBAL", argument.variable,
                     num(argument.low), num(argument.high), argument.kind == ArgumentKind::Whole ? " INT" : "",
                     argument.presence == Presence::Optional ? " OPTIONAL" : "");
}

bool reads(const std::string &body, std::uint32_t variable) {
  const std::string name = fmt::format("#{}", variable);
  for (std::size_t at = body.find(name); at != std::string::npos; at = body.find(name, at + 1))
    if (at + name.size() == body.size() || std::isdigit(static_cast<unsigned char>(body[at + name.size()])) == 0)
      return true;
  return false;
}

} // namespace

std::string num(double value) { return fmt::format("{:.15g}", value); }

Draft &Draft::promised(const Argument &argument) {
  promised_.push_back(argument);
  return *this;
}
Draft &Draft::free(std::uint32_t variable) {
  free_.push_back(variable);
  return *this;
}
Draft &Draft::line(std::string_view block) {
  body_ += block;
  body_ += '\n';
  return *this;
}
Draft &Draft::lines(std::initializer_list<std::string_view> blocks) {
  for (const std::string_view block : blocks)
    line(block);
  return *this;
}
Draft &Draft::other(std::initializer_list<std::string_view> blocks) {
  for (const std::string_view block : blocks) {
    others_ += block;
    others_ += '\n';
  }
  return *this;
}

Draft &Draft::proved(std::string_view claim) {
  answers_.push_back({std::string(claim), prove::Verdict::Proved});
  return *this;
}
Draft &Draft::refuted(std::string_view claim, Inputs shownBy) {
  answers_.push_back({std::string(claim), prove::Verdict::Refuted, std::move(shownBy)});
  return *this;
}

KnownProgram Draft::done() const {
  std::string contract; // a clause about a variable that is never read would be a mistake
  for (const Argument &argument : promised_)
    if (reads(body_, argument.variable))
      contract += clauseOf(argument);
  KnownProgram program{name_, "O9100\n" + contract + body_ + "M30\n" + others_, answers_, {}};
  std::replace(program.name.begin(), program.name.end(), '\n', ' ');
  Draw draw(7);
  for (int i = 0; i < kTrials; ++i) {
    Inputs inputs;
    for (const Argument &argument : promised_)
      if (argument.presence == Presence::Given || !draw.oneIn(3))
        inputs.emplace_back(argument.variable, within(draw, argument));
    for (const std::uint32_t variable : free_)
      if (!draw.oneIn(4))
        inputs.emplace_back(variable, draw.of({0., 1., -1., 2., 5., -7., .5, -.25, 12.5, 30.}));
    program.trials.push_back(std::move(inputs));
  }
  return program;
}

} // namespace feedhold::proof_tests
