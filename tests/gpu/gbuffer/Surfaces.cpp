#include "tests/gpu/gbuffer/Surfaces.h"

#include <algorithm>
#include <cmath>

#include "tests/support/Random.h"

namespace tessera::test {

std::vector<StoredSurface> randomSurfaces(int count) {
    Random random(11);
    std::vector<StoredSurface> surfaces;
    for (int i = 0; i < count; ++i) {
        StoredSurface s;
        s.albedo = {random.unit(), random.unit() * 0.01, i % 7 == 0 ? 1.0 : random.unit()};
        s.metallic = i % 3 == 0 ? float(random.index(2)) : float(random.unit());
        s.normal = glm::vec3(random.direction());
        s.alpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        s.specular = {random.unit(), random.unit(), random.unit()};
        constexpr unsigned kStoredModels[] = {
            unsigned(scenes::MaterialModel::Lambert),    unsigned(scenes::MaterialModel::SingleColor),
            unsigned(scenes::MaterialModel::Microfacet), unsigned(scenes::MaterialModel::MetallicRoughness),
            unsigned(scenes::MaterialModel::BlinnPhong), unsigned(scenes::MaterialModel::MicrofacetAnisotropic)};
        s.model = float(kStoredModels[i % 6]);
        const bool microfacet = i % 6 == 2 || i % 6 == 5;
        s.iorOrF90 = microfacet ? float(random.logarithmic(0.05, 1e4)) : float(random.unit());
        s.emission = glm::vec3(random.unit(), random.unit(), random.unit()) * float(random.logarithmic(1e-20, 1e20));
        s.normalTexel = {random.unit(), random.unit(), random.unit()};
        if (microfacet) { // never metallic
            s.metallic = 0.0f;
            s.masking = float(random.index(3));
        }
        if (s.model == float(scenes::MaterialModel::BlinnPhong)) { // no index of refraction
            s.iorOrF90 = 1.0f;
            s.exponent = i % 5 == 0 ? 0.0f : float(random.logarithmic(1e-3, 1e6));
        }
        s.tangent = glm::vec3(random.around(glm::normalize(glm::dvec3(s.normal)), 0.0, 0.0));
        s.alphaBitangent = i % 4 == 0 ? s.alpha : float(random.logarithmic(ALPHA_MIN, 1.0));
        s.coatNormal = {random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        s.coatFactor = i % 3 == 0 ? float(random.index(2)) : float(random.unit());
        s.coatAlpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        s.sheenColor = {random.unit(), random.unit(), i % 3 == 0 ? 0.0 : random.unit()};
        s.sheenAlpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        surfaces.push_back(s);
    }
    // The axes and the seams of the octahedron, where the sign of zero matters.
    for (const glm::vec3 n :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),
          glm::vec3(0, 0, -1), glm::vec3(-0.6f, 0, -0.8f), glm::vec3(0, 0.6f, -0.8f)}) {
        surfaces.emplace_back().normal = n;
        surfaces.back().tangent = n.x == 0.0f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    }
    return surfaces;
}

glm::vec3 fromOctahedral(double x, double y) {
    glm::dvec3 n(x, y, 1.0 - std::abs(x) - std::abs(y));
    if (n.z < 0.0) {
        const glm::dvec2 p(n);
        n.x = (1.0 - std::abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0);
        n.y = (1.0 - std::abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0);
    }
    return glm::vec3(glm::normalize(n));
}

std::vector<StoredSurface> surfacesBetweenSteps(frame::Encoding encoding, int count) {
    const auto widthsOf = [encoding](frame::Channel channel) {
        const frame::ChannelInfo& info = frame::channelTable()[std::size_t(channel)];
        return encoding == frame::Encoding::Packed ? info.packed : info.slim;
    };
    Random random(12);
    // Halfway between two of this many steps of 0..1, shifted a little to either side.
    const auto between = [&](int steps) {
        return std::clamp((random.index(steps) + 0.5 + random.between(-1e-3, 1e-3)) / steps, 0.0, 1.0);
    };
    const auto largest = [](int width) { return (1 << width) - 1; };
    const auto color = [&](const frame::FieldWidths& widths) {
        glm::vec3 c;
        for (int i = 0; i < 3; ++i) {
            const double root = between(largest(widths[std::size_t(i)]) / 5 * 5);
            c[i] = float(root * root);
        }
        return c;
    };
    const auto alpha = [&](int width) {
        const double least = std::pow(ALPHA_MIN, 0.25);
        return float(std::max(ALPHA_MIN, std::pow(1.0 - (1.0 - least) * (1.0 - between(largest(width))), 4.0)));
    };
    const auto coordinate = [&](int width) { return 2.0 * between(largest(width) - 1) - 1.0; };
    const frame::FieldWidths normal = widthsOf(frame::Channel::Normal), micro = widthsOf(frame::Channel::Microsurface),
                             emission = widthsOf(frame::Channel::Emission), tangent = widthsOf(frame::Channel::Tangent),
                             coat = widthsOf(frame::Channel::Clearcoat), sheen = widthsOf(frame::Channel::Sheen);
    std::vector<StoredSurface> surfaces;
    for (int i = 0; i < count; ++i) {
        StoredSurface s;
        s.albedo = color(widthsOf(frame::Channel::Albedo));
        s.specular = color(widthsOf(frame::Channel::Specular));
        s.sheenColor = color(sheen);
        s.normal = fromOctahedral(coordinate(normal[0]), coordinate(normal[1]));
        if (i % 2 == 0) // the centre of a face, where a step spans the widest angle
            s.normal = fromOctahedral(1.0 / 3.0 + random.between(-0.02, 0.02), 1.0 / 3.0 + random.between(-0.02, 0.02));
        s.alpha = alpha(micro[1]);
        s.alphaBitangent = alpha(tangent[2]);
        s.coatAlpha = alpha(coat[3]);
        s.sheenAlpha = alpha(sheen[3]);
        s.coatNormal = {coordinate(coat[0]), coordinate(coat[1])};
        s.coatFactor = float(between(largest(coat[2])));
        s.normalTexel = {between(255), between(255), between(255)};
        switch (i % 3) {
        case 0: {
            s.masking = float(random.index(3));
            const double contrast = 2.0 * between(largest(micro[2] + micro[3]) / 10 * 10) - 1.0;
            s.iorOrF90 = float((1.0 + contrast) / (1.0 - contrast));
            break;
        }
        case 1:
            s.model = float(scenes::MaterialModel::MetallicRoughness);
            s.iorOrF90 = float(between(largest(micro[2])));
            s.metallic = float(between(largest(micro[3])));
            break;
        default: {
            s.model = float(scenes::MaterialModel::BlinnPhong);
            const int mantissa = micro[1] + micro[2] + micro[3] - 8;
            s.exponent = float(std::ldexp(1.0 + (random.index(8) + 0.5) / (1 << mantissa), random.index(20) - 3));
        }
        }
        // The largest colour just above a power of two has the coarsest steps for its size.
        const int power = random.index(60) - 27; // within the range of every layout
        const auto radiance = [&](std::uint8_t width) {
            return std::ldexp(0.5 + (random.index(4) + 0.5) / (1 << width), power);
        };
        s.emission = glm::dvec3(radiance(emission[1]), radiance(emission[2]), radiance(emission[3]));
        const glm::dvec3 n(s.normal);
        const glm::dvec3 axis = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? glm::dvec3(1, 0, 0)
                                : std::abs(n.y) <= std::abs(n.z)                                 ? glm::dvec3(0, 1, 0)
                                                                                                 : glm::dvec3(0, 0, 1);
        const glm::dvec3 first = glm::normalize(glm::cross(axis, n)), second = glm::cross(n, first);
        const double point = coordinate(tangent[1]);
        s.tangent = glm::vec3(glm::normalize(point * first + (1.0 - std::abs(point)) * second));
        surfaces.push_back(s);
    }
    return surfaces;
}

std::vector<StoredSurface> surfacesAtTheEnds() {
    std::vector<StoredSurface> surfaces;
    for (const float x : {0.0f, 1.0f, 1e-30f, 0.04f, std::nextafter(1.0f, 0.0f)}) {
        StoredSurface& s = surfaces.emplace_back();
        s.albedo = s.specular = s.sheenColor = s.normalTexel = glm::vec3(x);
        s.coatFactor = s.metallic = s.iorOrF90 = x;
        s.model = float(scenes::MaterialModel::MetallicRoughness);
        s.coatNormal = {x, -x};
    }
    for (const double alpha : {ALPHA_MIN, 1.0, ALPHA_MIN * 1.0001, 0.999999}) {
        StoredSurface& s = surfaces.emplace_back();
        s.alpha = s.alphaBitangent = s.coatAlpha = s.sheenAlpha = float(alpha);
    }
    for (const float ior : {1e-6f, 0.1f, 0.999999f, 1.0f, 1.000001f, 1.5f, 100.0f, 1e4f, 1e6f})
        surfaces.emplace_back().iorOrF90 = ior;
    for (int power = -66; power <= 66; ++power) { // 2^66 = 7.4e19
        for (const float value : {std::ldexp(1.0f, power), std::nextafter(std::ldexp(1.0f, power), 0.0f)}) {
            surfaces.emplace_back().emission = glm::vec3(value, 0.999f * value, 0.0f);
            surfaces.emplace_back().emission = glm::vec3(0.0f, 1e-3f * value, value);
        }
    }
    surfaces.emplace_back().emission = glm::vec3(1e20f, 1e-20f, 1.0f);
    surfaces.emplace_back().emission = glm::vec3(0.0f);
    for (const float zero : {0.0f, -0.0f}) {
        for (const glm::vec3 n :
             {glm::vec3(zero, zero, 1), glm::vec3(zero, zero, -1), glm::vec3(0.6f, zero, -0.8f),
              glm::vec3(-0.6f, zero, -0.8f), glm::vec3(zero, 0.6f, -0.8f), glm::vec3(zero, -0.6f, -0.8f),
              glm::vec3(0.6f, -0.8f, zero), glm::vec3(-0.6f, 0.8f, zero), glm::vec3(1, zero, zero)}) {
            StoredSurface& s = surfaces.emplace_back();
            s.normal = n;
            s.tangent = n.x == 0.0f ? glm::vec3(1, 0, 0) : glm::vec3(glm::normalize(glm::vec3(-n.y, n.x, 0.0f)));
            if (n.x != 0.0f && n.y == 0.0f) s.tangent = glm::vec3(0, 1, 0);
        }
    }
    return surfaces;
}

} // namespace tessera::test
