// See the header.
#include "rules/motion/folder_programs.h"

#include <filesystem>

namespace feedhold::rules {
namespace {

constexpr std::size_t kEnough = 50;

/// Without a copy: each file of a run asks it of all files.
std::string_view folderOf(std::string_view path) {
  constexpr std::string_view kSeparators = std::filesystem::path::preferred_separator == '/' ? "/" : "/\\";
  const std::size_t end = path.find_last_of(kSeparators);
  return end == std::string_view::npos ? std::string_view() : path.substr(0, end);
}

} // namespace

std::vector<FileId> filesOfFolder(const FileContext &context) {
  const std::string_view folder = folderOf(context.source.path());
  std::vector<FileId> files;
  for (std::size_t i = 0; i < context.programs->size() && files.size() < kEnough; ++i)
    if (folderOf(context.programs->file(FileId(i)).source->path()) == folder)
      files.push_back(FileId(i));
  return files;
}

FileContext contextOf(const ProgramFile &file, const FileContext &context) {
  return {file.file, *file.source, *file.dialect, *file.tree, *file.model, context.callGraph, context.programs};
}

} // namespace feedhold::rules
