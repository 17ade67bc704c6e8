#include "evolve/run/shared_disk.h"

#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace metamorph::evolve {
namespace {

// From linux/magic.h where it has them, else from the systems' own sources.
constexpr std::array<std::pair<std::uint32_t, std::string_view>, 14> kinds = {{
    {0x6969, "NFS"},
    {0x47504653, "GPFS"},
    {0x0BD00BD0, "Lustre"},
    {0x19830326, "BeeGFS"},
    {0x00C36400, "Ceph"},
    {0x20030528, "OrangeFS"},
    {0xFF534D42, "CIFS"},
    {0xFE534D42, "SMB"},
    {0x517B, "SMB"},
    {0x01021997, "9P"},
    {0x5346414F, "AFS"},
    {0x01161970, "GFS2"},
    {0x7461636F, "OCFS2"},
    {0x65735546, "FUSE"},
}};

}  // namespace

std::optional<std::string_view> shared_kind(unsigned long magic) {
  // Where a long is signed, numbers above 2^31 come with their sign repeated.
  const auto number = static_cast<std::uint32_t>(magic);
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const auto& kind) { return kind.first == number; });
  if (found == kinds.end()) return std::nullopt;
  return found->second;
}

std::optional<std::string_view> shared_disk_of(const std::filesystem::path& directory) {
  struct statfs facts{};
  if (statfs(directory.c_str(), &facts) != 0) return std::nullopt;
  return shared_kind(static_cast<unsigned long>(facts.f_type));
}

}  // namespace metamorph::evolve
