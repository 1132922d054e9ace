// The platform on POSIX systems with ELF.
#include "surface/cli/platform.h"

#include <fmt/format.h>

#include <elf.h>
#include <link.h>
#include <string_view>
#include <unistd.h>

namespace feedhold {

namespace {

std::size_t aligned(std::size_t size) { return (size + 3) / 4 * 4; }

/// The linker's hash of what it has put together, in the notes of an object (man 5 elf, "Notes").
std::string buildIdIn(std::string_view notes) {
  while (notes.size() > sizeof(ElfW(Nhdr))) {
    const auto *head = reinterpret_cast<const ElfW(Nhdr) *>(notes.data());
    const std::size_t value = sizeof *head + aligned(head->n_namesz);
    const std::size_t end = value + aligned(head->n_descsz);
    if (end > notes.size())
      break;
    std::string id;
    if (head->n_type == NT_GNU_BUILD_ID)
      for (const char c : notes.substr(value, head->n_descsz))
        id += fmt::format("{:02x}", static_cast<unsigned char>(c));
    if (!id.empty())
      return id;
    notes.remove_prefix(end);
  }
  return "";
}

/// The program itself is the first object; behind it come the libraries.
int lookAt(dl_phdr_info *object, std::size_t, void *result) {
  auto &id = *static_cast<std::string *>(result);
  for (int i = 0; i < object->dlpi_phnum && id.empty(); ++i)
    if (const auto &part = object->dlpi_phdr[i]; part.p_type == PT_NOTE)
      id = buildIdIn({reinterpret_cast<const char *>(object->dlpi_addr + part.p_vaddr), part.p_memsz});
  return 1;
}

} // namespace

std::vector<std::string> beginProgram(int argc, char **argv) { return {argv + (argc > 0 ? 1 : 0), argv + argc}; }

bool isTerminal(Stream stream) { return ::isatty(stream == Stream::Output ? STDOUT_FILENO : STDERR_FILENO) != 0; }

std::uint64_t processId() { return static_cast<std::uint64_t>(::getpid()); }

std::string buildId() {
  std::string id;
  dl_iterate_phdr(lookAt, &id);
  return id;
}

} // namespace feedhold
