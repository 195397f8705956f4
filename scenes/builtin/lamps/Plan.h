#pragma once

/// The reading hall's measures in metres: a nave along Z with desks, on both sides bookcases that stand across it under
/// a gallery, and above the gallery more books along the outer walls.
namespace tessera::scenes::builtin::lamps {

inline constexpr double kHalfWidth = 11.0;
inline constexpr double kHalfLength = 24.0;
inline constexpr double kCeilingY = 7.2;
inline constexpr double kNaveHalf = 4.5; ///< where the galleries begin
inline constexpr double kGalleryUnderY = 3.4;
inline constexpr double kGalleryFloorY = 3.6;

inline constexpr int kCases = 16; ///< per side
inline constexpr double kCaseSpacing = 3.0;
inline constexpr double kCaseX = 5.2; ///< end towards the nave
inline constexpr double kCaseLength = 5.2;
inline constexpr double kCaseHalfDepth = 0.34;
inline constexpr double kCaseY = 2.75;
inline constexpr int kShelves = 5; ///< per face of a case
inline constexpr double kFirstShelfY = 0.1;
inline constexpr double kShelfSpacing = 0.5;
inline constexpr double kBoard = 0.025; ///< thickness of a shelf

inline constexpr int kDesks = 12; ///< per side of the nave
inline constexpr double kDeskSpacing = 4.0;
inline constexpr double kDeskX = 1.9;
inline constexpr double kDeskY = 0.78;
inline constexpr int kDeskLamps = 4; ///< per desk
inline constexpr double kDeskLampSpacing = 0.62;
inline constexpr double kShadeY = 1.14; ///< lower edge of the desk lamps' shades

inline constexpr double kLuminaireY = 5.2; ///< of the panels that hang over the nave

inline constexpr int kUpperShelves = 4;
inline constexpr double kUpperShelfY = 4.0; ///< lowest shelf over the gallery
inline constexpr double kUpperShelfDepth = 0.3;
inline constexpr double kWasherX = 10.25; ///< of the strips that illuminate these shelves
inline constexpr double kWasherY = 6.55;

/// Z of the middle of case 0..kCases-1 and of desk 0..kDesks-1, from the window.
inline constexpr double caseZ(int index) {
    return -kHalfLength + (index + 0.5) * kCaseSpacing;
}
inline constexpr double deskZ(int index) {
    return -kHalfLength + (index + 0.5) * kDeskSpacing;
}
/// Relative to the middle of its desk.
inline constexpr double deskLampZ(int index) {
    return kDeskLampSpacing * (index - 0.5 * (kDeskLamps - 1));
}
/// Y of the upper side of board 0..kShelves of a case.
inline constexpr double boardY(int index) {
    return kFirstShelfY + index * kShelfSpacing;
}

} // namespace tessera::scenes::builtin::lamps
