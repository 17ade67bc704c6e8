#pragma once

#include <string>
#include <string_view>

#include "evolve/experiment/keys.h"
#include "evolve/experiment/toml.h"

namespace metamorph::evolve {

/// Whether a text may name an experiment, a trial or a scene.
bool is_name(std::string_view text);

/// Stores a value in the key's field; false if type or range are wrong. What is more to say of that
/// than what the key expects is left in `fault`.
bool assign(const Key& key, const toml::node& node, std::string& fault);

/// A value as a line about it shows it.
std::string shown(const toml::node& node);

}  // namespace metamorph::evolve
