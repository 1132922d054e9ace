// See the header.
#include "rules/motion/folder_programs.h"

#include <filesystem>

namespace feedhold::rules {
namespace {

constexpr std::size_t kEnough = 50;

} // namespace

std::vector<FileId> filesOfFolder(const FileContext &context) {
  const auto folder = std::filesystem::path(context.source.path()).parent_path();
  std::vector<FileId> files;
  for (std::size_t i = 0; i < context.programs->size() && files.size() < kEnough; ++i)
    if (std::filesystem::path(context.programs->file(FileId(i)).source->path()).parent_path() == folder)
      files.push_back(FileId(i));
  return files;
}

FileContext contextOf(const ProgramFile &file, const FileContext &context) {
  return {file.file, *file.source, *file.dialect, *file.tree, *file.model, context.callGraph, context.programs};
}

} // namespace feedhold::rules
