// The connected components of the call graph, the dearest first, each to the shard that has the least to do so far.
#include "findings/project/shards.h"

#include "findings/project/project.h"

#include <algorithm>
#include <numeric>

namespace feedhold {

namespace {

/// Sets of files that can only grow together.
class Components {
public:
  explicit Components(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

  std::size_t rootOf(std::size_t item) {
    while (parents_[item] != item)
      item = parents_[item] = parents_[parents_[item]];
    return item;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t first = std::min(rootOf(a), rootOf(b));
    parents_[std::max(rootOf(a), rootOf(b))] = first;
  }

private:
  std::vector<std::size_t> parents_;
};

Components componentsOf(const Project &project) {
  Components components(project.files.size());
  for (std::size_t i = 0; i < project.files.size(); ++i)
    for (const Call &call : project.files[i]->model.calls)
      for (const ProgramRef &callee : project.callGraph.candidates(FileId(i), call))
        components.join(i, callee.file.index());
  return components;
}

/// Of which the known costs are; one that is unknown is taken for the average of its size.
std::vector<std::uint64_t> costsOf(const std::vector<WorkItem> &items, const FileCosts &costs) {
  std::vector<std::uint64_t> result;
  double knownCost = 0;
  double knownBytes = 0;
  for (const WorkItem &item : items)
    if (const auto known = costs.find(item.shown); known != costs.end()) {
      knownCost += static_cast<double>(known->second);
      knownBytes += static_cast<double>(item.source.text().size());
    }
  const double perByte = knownBytes > 0 ? knownCost / knownBytes : 1;
  for (const WorkItem &item : items) {
    const auto known = costs.find(item.shown);
    const double guess = perByte * static_cast<double>(item.source.text().size());
    result.push_back(known != costs.end() ? known->second : 1 + static_cast<std::uint64_t>(guess));
  }
  return result;
}

} // namespace

std::set<std::string> filesOfShard(const CheckOptions &options, const KnownNames &known, Shard shard,
                                   const FileCosts &costs) {
  const Workload workload = loadWorkload(options, known);
  const std::vector<WorkItem> &items = workload.items;
  const Project project = loadProject(items, {.graphs = LoadGraphs::No, .jobs = options.jobs, .open = options.open});
  Components components = componentsOf(project);
  const std::vector<std::uint64_t> fileCosts = costsOf(items, costs);
  std::vector<std::uint64_t> componentCosts(items.size(), 0);
  for (std::size_t i = 0; i < items.size(); ++i)
    componentCosts[components.rootOf(i)] += fileCosts[i];

  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (components.rootOf(i) == i)
      roots.push_back(i);
  std::stable_sort(roots.begin(), roots.end(),
                   [&](std::size_t a, std::size_t b) { return componentCosts[a] > componentCosts[b]; });
  std::vector<std::uint64_t> loads(shard.count, 0);
  std::set<std::size_t> own;
  for (const std::size_t root : roots) {
    const auto least = std::min_element(loads.begin(), loads.end());
    *least += componentCosts[root];
    if (least - loads.begin() + 1 == static_cast<std::ptrdiff_t>(shard.index))
      own.insert(root);
  }
  std::set<std::string> files;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (own.contains(components.rootOf(i)))
      files.insert(items[i].shown);
  return files;
}

} // namespace feedhold
