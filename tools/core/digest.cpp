#include "core/digest.hpp"

#include <cstring>

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gobo {
namespace {

/// The build id among the notes of a segment; empty where there is none.
std::string build_id(std::string_view notes) {
    const auto aligned = [](std::size_t size) { return (size + 3) / 4 * 4; };
    while (notes.size() >= sizeof(ElfW(Nhdr))) {
        ElfW(Nhdr) head{};
        std::memcpy(&head, notes.data(), sizeof head);
        notes.remove_prefix(sizeof head);
        const std::size_t size = aligned(head.n_namesz) + aligned(head.n_descsz);
        if (size > notes.size()) break;
        if (head.n_type == NT_GNU_BUILD_ID && notes.substr(0, head.n_namesz) == std::string_view("GNU", 4))
            return std::string(notes.substr(aligned(head.n_namesz), head.n_descsz));
        notes.remove_prefix(size);
    }
    return {};
}

/// Called for the program first, then for its libraries.
int find_build_id(dl_phdr_info* object, std::size_t, void* found) {
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = object->dlpi_phdr[i];
        std::string& id = *static_cast<std::string*>(found);
        if (segment.p_type == PT_NOTE && id.empty())
            id = build_id({reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr),
                           static_cast<std::size_t>(segment.p_memsz)});
    }
    return 1;
}

}  // namespace

Digest digest_of(std::string_view text) {
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return {hash.high64, hash.low64};
}

std::string hex(const Digest& digest) {
    return fmt::format("{:016x}{:016x}", digest.high, digest.low);
}

std::string program_identity() {
    std::string id;
    dl_iterate_phdr(&find_build_id, &id);
    if (!id.empty()) return id;
    struct stat file {};
    if (::stat("/proc/self/exe", &file) != 0) return {};
    return fmt::format("{} {} {}", file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec);
}

}  // namespace gobo
