#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Hashes everything that an image of a scene can depend on, with 64-bit FNV-1a; file names, notes and warnings are
/// excluded. Numbers are hashed by their bits, lists with their lengths, texels as stored. Struct layout does not
/// matter, so that a scene has the same fingerprint in every build. Source: Fowler, Noll, Vo, "The FNV
/// Non-Cryptographic Hash Algorithm" (IETF draft-eastlake-fnv).
std::uint64_t fingerprint(const Scene& scene);

/// The same hash of plain bytes, to distinguish files or texts.
std::uint64_t fingerprint(std::span<const std::byte> bytes);

} // namespace tessera::scenes
