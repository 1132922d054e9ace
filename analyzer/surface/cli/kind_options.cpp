#include "surface/cli/kind_options.h"

#include "proof/obligation/obligation_kinds.h"

#include <algorithm>

namespace feedhold {

void addOnlyKinds(CLI::App &app, std::vector<std::string> &names) {
  std::vector<std::string> known;
  for (const prove::ObligationKind kind : prove::kObligationKinds)
    known.emplace_back(nameOf(kind));
  app.add_option("--only", names, "prove only these kinds of obligations (comma-separated, or repeated)")
      ->type_name("KIND")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(known));
}

std::vector<prove::ObligationKind> kindsFrom(const std::vector<std::string> &names) {
  std::vector<prove::ObligationKind> kinds;
  for (const prove::ObligationKind kind : prove::kObligationKinds)
    if (std::find(names.begin(), names.end(), nameOf(kind)) != names.end())
      kinds.push_back(kind);
  return kinds;
}

} // namespace feedhold
