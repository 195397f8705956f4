#include "viewer/session/Magnification.h"

#include <algorithm>

namespace tessera::viewer {

void Magnification::zoom(int steps, const glm::vec2& share) {
    const glm::vec2 place = placeAt(share);
    for (; steps > 0 && times < kMost; --steps) times *= 2;
    for (; steps < 0 && times > 1; ++steps) times /= 2;
    corner = place - share / float(times);
    pan(glm::vec2(0.0f));
}

void Magnification::pan(const glm::vec2& share) {
    corner = glm::clamp(corner - share / float(times), 0.0f, 1.0f - 1.0f / float(times));
}

} // namespace tessera::viewer
