#include "proof/decide/known_models.h"

#include <algorithm>

namespace feedhold::prove {

bool KnownModels::refute(const Query &query) {
  const auto denies = [&](Known &known) {
    return known.values.is(query.goal, false) &&
           std::ranges::all_of(query.assumptions, [&](smt::TermId each) { return known.values.is(each, true); });
  };
  const auto found = std::ranges::find_if(models_, denies);
  if (found == models_.end())
    return false;
  models_.splice(models_.begin(), models_, found);
  return true;
}

void KnownModels::add(const smt::Model &model) {
  constexpr std::size_t kMostModels = 12;
  models_.emplace_front(store_, model);
  if (models_.size() > kMostModels)
    models_.pop_back();
}

} // namespace feedhold::prove
