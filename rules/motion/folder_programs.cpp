// See the header.
#include "rules/motion/folder_programs.h"

#include <algorithm>

namespace feedhold::rules {
namespace {

constexpr std::size_t kEnough = 50;

} // namespace

std::span<const FileId> filesOfFolder(const FileContext &context) {
  const auto files = context.programs->inFolderOf(context.file);
  return files.first(std::min(files.size(), kEnough));
}

FileContext contextOf(const ProgramFile &file, const FileContext &context) {
  return {file.file, *file.source, *file.dialect, *file.tree, *file.model, context.callGraph, context.programs};
}

} // namespace feedhold::rules
