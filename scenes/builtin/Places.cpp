#include "scenes/builtin/Places.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "scenes/builtin/Random.h"

namespace tessera::scenes::builtin {

void addLightsAtPlaces(Scene& scene, std::span<const Light> places, int count, int stride, double crowdMetres) {
    const int placeCount = static_cast<int>(places.size());
    assert(std::gcd(stride, placeCount) == 1);
    // Few lights would have to be glaring to light everything: the factor is limited to 4.
    constexpr double kBrightest = 4.0;
    const double share = count == 0 ? 0.0 : std::min(kBrightest, static_cast<double>(placeCount) / count);
    Random random(2027);
    for (int i = 0; i < count; ++i) {
        Light light = places[static_cast<std::size_t>(std::int64_t{i} * stride % placeCount)];
        light.intensity = static_cast<float>(light.intensity * share);
        if (i >= placeCount) {
            // A random point of the unit ball around the place, drawn in this order.
            glm::dvec3 offset;
            do {
                offset.x = random.between(-1.0, 1.0);
                offset.y = random.between(-1.0, 1.0);
                offset.z = random.between(-1.0, 1.0);
            } while (glm::dot(offset, offset) > 1.0);
            light.positionWS += crowdMetres * offset;
            light.name.append(".").append(std::to_string(i / placeCount));
        }
        scene.lights.push_back(std::move(light));
    }
}

} // namespace tessera::scenes::builtin
