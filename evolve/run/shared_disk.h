#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace metamorph::evolve {

/// The name of a kind of file system that several machines may have mounted, by its number in
/// statfs(2); none if it is another kind. Through FUSE anything may come: it counts as shared.
std::optional<std::string_view> shared_kind(unsigned long magic);

/// The kind of the file system that an existing directory lies on, if it is a shared one.
std::optional<std::string_view> shared_disk_of(const std::filesystem::path& directory);

}  // namespace metamorph::evolve
