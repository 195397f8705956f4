#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// A number that tells two scenes apart: FNV-1a of 64 bits over all that a picture can depend on, which is everything
/// but the warnings. Numbers count by their bits, lists by their lengths too, and nothing of how structs lie in memory
/// enters, so that the same scene has the same number in every build. Texels count as they are stored.
/// Source: Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm" (IETF draft-eastlake-fnv).
std::uint64_t fingerprint(const Scene& scene);

/// The same hash of bytes alone: tells two files or texts apart.
std::uint64_t fingerprint(std::span<const std::byte> bytes);

} // namespace tessera::scenes
