#pragma once

/// The hall's measures in metres: a nave along Z under a coffered barrel vault, columns with arches on both sides,
/// aisles behind them with niches in their outer walls, an apse at the far end (-Z) and a portal at the near one.
namespace tessera::scenes::builtin::hall {

inline constexpr int kBays = 10; ///< from one column to the next, along Z
inline constexpr double kBayLength = 4.0;
inline constexpr double kHalfLength = 0.5 * kBays * kBayLength;

inline constexpr double kColumnX = 4.0;   ///< axis of the columns
inline constexpr double kWallHalf = 0.35; ///< of the wall above the arches
inline constexpr double kNaveHalf = kColumnX - kWallHalf;
inline constexpr double kAisleOuterX = 8.0;

inline constexpr double kImpostY = 5.7; ///< columns end, arches begin
inline constexpr double kArchRadius = 1.6;
inline constexpr double kCorniceY = 8.2; ///< between arches and windows
inline constexpr double kWindowSillY = 9.05;
inline constexpr double kWindowSpringY = 9.75;
inline constexpr double kWindowHalf = 0.68;
inline constexpr double kVaultSpringY = 10.6;
inline constexpr double kVaultRadius = kNaveHalf;
inline constexpr double kAisleVaultSpringY = 7.65; ///< above the arches, whose tops open into the vault

inline constexpr double kNicheSillY = 0.9;
inline constexpr double kNicheSpringY = 2.7;
inline constexpr double kNicheRadius = 0.8;

inline constexpr double kApseRadius = 3.0;
inline constexpr double kApseSpringY = 5.7;
inline constexpr double kPortalHalf = 1.3;
inline constexpr double kPortalSpringY = 3.2;

/// Z of the middle of bay 0..kBays-1, and of column 0..kBays, from the apse.
inline constexpr double bayZ(int bay) {
    return -kHalfLength + (bay + 0.5) * kBayLength;
}
inline constexpr double columnZ(int column) {
    return -kHalfLength + column * kBayLength;
}

} // namespace tessera::scenes::builtin::hall
