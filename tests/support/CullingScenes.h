#pragma once
#include <cstdint>

#include "scenes/Scene.h"

namespace tessera::test {

/// A random scene for tests of light culling: a floor, boxes and cards, some of them transparent, viewed by a random
/// perspective or orthographic camera, and lit by point, spot and directional lights of every falloff, range and cone,
/// some of which contain the camera or lie behind it. The same for the same seed.
scenes::Scene randomLitScene(std::uint64_t seed);

/// Adds four faint lights of infinite range, one of each kind, so that all such scenes are drawn by the same programs.
scenes::Scene withEveryKindOfLight(scenes::Scene scene);

/// Nearly the same view from `times` as far away: the eye moves back along its axis, a perspective field of view
/// narrows, and the near and far planes stay where they are.
scenes::Camera seenFromAfar(scenes::Camera camera, double times);

/// A scene of large depth discontinuities: two rows of columns and a curtain of leaf-like cards before a far wall, with
/// `lights` small lights between.
scenes::Scene columnsBeforeWall(int lights);

/// The scene with its lights replaced by `lights` white lights of that range at random positions within its bounds. A
/// camera inside looks along the longer horizontal side, from a fifth of it and 30 % of the height.
scenes::Scene litFromWithin(scenes::Scene scene, int lights, float rangeMetres);

} // namespace tessera::test
