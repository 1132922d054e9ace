#include "language/model/repeated_labels.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace feedhold {

namespace {

/// A construct around another, and the part of it in which that stands: 1 behind the `if`, 2 behind its `elseif`.
struct Around {
  ConstructId construct;
  std::size_t part;
  friend bool operator==(const Around &, const Around &) = default;
};
using Nesting = std::vector<Around>; // from the outside in

struct Head {
  ConstructId construct;
  Nesting around;
};

class LabelRepetitions {
public:
  explicit LabelRepetitions(const ProgramModel &model) : model_(model) {
    for (std::size_t i = 0; i < model.constructs.size(); ++i) {
      const OWordUse &head = headOf(ConstructId(i));
      if (kindOf(ConstructId(i)) != OWordKind::Sub && !head.label.empty())
        byLabel_[{head.program, head.label}].push_back({ConstructId(i), {}});
    }
  }

  std::map<ConstructId, LabelRepetition> find() {
    for (auto &[label, heads] : byLabel_) {
      if (heads.size() == 1)
        continue;
      for (Head &head : heads)
        head.around = nestingOf(head.construct);
      for (const Head &head : heads)
        for (const Head &other : heads)
          if (const auto kind = other.construct == head.construct ? std::nullopt : kindAt(head, other))
            take(head.construct, {*kind, other.construct});
    }
    return std::move(found_);
  }

private:
  OWordKind kindOf(ConstructId id) const { return model_.constructs[id].kind; }
  OWordId headWordOf(ConstructId id) const { return model_.constructs[id].parts.front(); }
  const OWordUse &headOf(ConstructId id) const { return model_.oWords[headWordOf(id)]; }

  void take(ConstructId construct, LabelRepetition repetition) {
    const auto [known, isNew] = found_.try_emplace(construct, repetition);
    if (!isNew && known->second.kind < repetition.kind)
      known->second = repetition;
  }

  /// The model has the constructs in order of their heads.
  Nesting nestingOf(ConstructId id) const {
    const OWordId head = headWordOf(id);
    Nesting nesting;
    for (std::size_t i = 0; i < model_.constructs.size() && headWordOf(ConstructId(i)) < head; ++i) {
      const Construct &around = model_.constructs[ConstructId(i)];
      const auto part = std::ranges::upper_bound(around.parts, head);
      if (around.kind != OWordKind::Sub && part != around.parts.end() &&
          headOf(ConstructId(i)).program == headOf(id).program)
        nesting.push_back({ConstructId(i), static_cast<std::size_t>(part - around.parts.begin())});
    }
    return nesting;
  }

  /// A head that has been met at least once before another, whenever that is met.
  bool comesBefore(const Head &head, const Head &other, std::size_t common) const {
    return headWordOf(head.construct) < headWordOf(other.construct) && common == head.around.size() &&
           kindOf(head.construct) != OWordKind::Do && kindOf(other.construct) != OWordKind::Do;
  }

  /// What the other head does to this one.  Two `do` find each its own `while`, and do not stop.
  std::optional<RepeatedLabel> kindAt(const Head &head, const Head &other) const {
    const Nesting &here = head.around, &there = other.around;
    const auto parted = std::ranges::mismatch(here, there).in1;
    const auto common = static_cast<std::size_t>(parted - here.begin());
    if (comesBefore(other, head, common))
      return RepeatedLabel::Surely;
    if (comesBefore(head, other, common) ||
        (kindOf(head.construct) == OWordKind::Do && kindOf(other.construct) == OWordKind::Do))
      return std::nullopt;
    const auto isLoop = [this](const Around &each) { return kindOf(each.construct) != OWordKind::If; };
    const ProgramId program = headOf(head.construct).program;
    const bool isCalled = program != ProgramId(0) || model_.programs[program].returns;
    const bool isInLoop = std::any_of(here.begin(), parted, isLoop);
    const bool isInOtherBranch =
        common < here.size() && common < there.size() && here[common].construct == there[common].construct;
    const bool isLater = headWordOf(other.construct) < headWordOf(head.construct);
    if (isInLoop || (isLater && !isInOtherBranch))
      return RepeatedLabel::Perhaps;
    if (!isCalled)
      return std::nullopt;
    return isInOtherBranch ? RepeatedLabel::Rarely : RepeatedLabel::Perhaps;
  }

  const ProgramModel &model_;
  std::map<std::pair<ProgramId, std::string>, std::vector<Head>> byLabel_;
  std::map<ConstructId, LabelRepetition> found_;
};

} // namespace

std::map<ConstructId, LabelRepetition> repeatedLabels(const ProgramModel &model) {
  return LabelRepetitions(model).find();
}

} // namespace feedhold
