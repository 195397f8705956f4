#pragma once
#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "shaders/shared/models.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera::test {

/// A surface of any model and layers, with directions to a light and to the viewer.
struct LobeCase {
    unsigned model = unsigned(scenes::MaterialModel::MetallicRoughness);
    glm::vec3 albedo{0.5f};
    float metallic = 0.0f;
    glm::vec3 n{0, 0, 1};
    float alpha = 0.5f;
    glm::vec3 specular{0.04f};
    float iorOrF90 = 1.0f;
    glm::vec3 l{0, 0, 1};
    glm::vec3 v{0, 0, 1};
    float exponent = 1.0f;
    glm::vec3 tangent{1, 0, 0};
    float alphaBitangent = 0.5f;
    glm::vec3 coatNormal{0, 0, 1};
    float coatFactor = 0.0f;
    float coatAlpha = 0.5f;
    glm::vec3 sheenColor{0.0f};
    float sheenAlpha = 0.5f;
    unsigned masking = MASKING_WALTER;
};

struct LobeResult {
    glm::vec3 brdfCosine;
    float nl;
    float d, v, f;
};

/// Single terms, in the order of lobe_terms.comp.
struct LobeTerms {
    float anisotropicD, isotropicD, smithLength, alphaAlong;
    float blinnPhong, charlieD, charlieV, sheenAlbedo;
};
struct TermsCase {
    glm::vec3 n{0, 0, 1};
    glm::vec2 alpha{0.5f};
    glm::vec3 h{0, 0, 1};
    glm::vec3 tangent{1, 0, 0};
    float exponent = 1.0f;
    glm::vec3 direction{0, 0, 1};
    float cosine = 1.0f;
};

class LobeTest : public GlTest {
protected:
    std::vector<LobeResult> run(const std::vector<LobeCase>& cases) {
        std::vector<glm::vec4> in;
        in.reserve(cases.size() * 9);
        for (const LobeCase& c : cases) {
            in.insert(in.end(), {{c.albedo, c.metallic},
                                 {c.n, c.alpha},
                                 {c.specular, c.iorOrF90},
                                 {c.l, float(c.model)},
                                 {c.v, c.exponent},
                                 {c.tangent, c.alphaBitangent},
                                 {c.coatNormal, c.coatFactor},
                                 {c.sheenColor, c.sheenAlpha},
                                 {c.coatAlpha, float(c.masking), 0, 0}});
        }
        const std::vector<glm::vec4> out = bench_.run("test/lobes.comp", kEverything, in, cases.size(), 2);
        std::vector<LobeResult> results;
        results.reserve(cases.size());
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::vec4 &a = out[2 * i], &b = out[2 * i + 1];
            results.push_back({glm::vec3(a), a.w, b.x, b.y, b.z});
        }
        return results;
    }
    LobeResult run(const LobeCase& one) { return run(std::vector{one}).front(); }

    std::vector<LobeTerms> terms(const std::vector<TermsCase>& cases) {
        std::vector<glm::vec4> in;
        in.reserve(cases.size() * 4);
        for (const TermsCase& c : cases)
            in.insert(in.end(), {{c.n, c.alpha.x}, {c.h, c.alpha.y}, {c.tangent, c.exponent}, {c.direction, c.cosine}});
        const std::vector<glm::vec4> out = bench_.run("test/lobe_terms.comp", {}, in, cases.size(), 2);
        std::vector<LobeTerms> results;
        results.reserve(cases.size());
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::vec4 &a = out[2 * i], &b = out[2 * i + 1];
            results.push_back({a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w});
        }
        return results;
    }

    static bool isFiniteAndPositive(const glm::vec3& c) {
        return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0.0f && c.y >= 0.0f &&
               c.z >= 0.0f;
    }

    /// The surface without coat and sheen, and with the masking that every model supports.
    static LobeCase bare(LobeCase c) {
        c.masking = MASKING_WALTER;
        c.coatFactor = 0.0f;
        c.sheenColor = glm::vec3(0.0f);
        return c;
    }

    /// A random surface of the model, sometimes with directions at the edges of their domain.
    static LobeCase randomCase(Random& random, unsigned model) {
        LobeCase c;
        c.model = model;
        const bool microfacet = model == unsigned(scenes::MaterialModel::Microfacet) ||
                                model == unsigned(scenes::MaterialModel::MicrofacetAnisotropic);
        const auto alpha = [&] {
            return random.index(4) == 0 ? float(ALPHA_MIN) : float(random.logarithmic(ALPHA_MIN, 1.0));
        };
        c.albedo = {random.unit(), random.unit(), random.unit()};
        c.metallic = float(random.index(3) == 0 ? random.index(2) : random.unit());
        c.n = glm::vec3(random.direction());
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
        c.alpha = alpha();
        c.alphaBitangent = random.index(4) == 0 ? c.alpha : alpha();
        c.specular = {random.unit(), random.unit(), random.unit()};
        c.iorOrF90 = float(microfacet ? random.logarithmic(0.2, 1000.0) : random.unit());
        c.exponent = random.index(5) == 0 ? 0.0f : float(random.logarithmic(1e-3, 1e6));
        c.tangent = glm::vec3(random.around(n, 0.0, 0.0));
        c.coatNormal = random.index(2) == 0 ? c.n : glm::vec3(random.around(n, 0.5, 1.0));
        c.coatFactor = random.index(3) == 0 ? float(random.index(2)) : float(random.unit());
        c.coatAlpha = alpha();
        if (random.index(3) != 0) c.sheenColor = {random.unit(), random.unit(), random.unit()};
        c.sheenAlpha = alpha();
        c.masking = unsigned(random.index(3));
        c.l = glm::vec3(random.around(n, -1.0, 1.0));
        c.v = glm::vec3(random.around(n, -1.0, 1.0));
        switch (random.index(10)) {
        case 0:
            c.v = -c.l;
            break;
        case 1:
            c.v = c.l;
            break;
        case 2:
            c.v = glm::vec3(glm::reflect(-glm::dvec3(c.l), n)); // the peak
            break;
        case 3:
            c.l = glm::vec3(random.around(n, -1e-6, 1e-6));
            break;
        case 4:
            c.v = glm::vec3(random.around(n, -1e-6, 1e-6));
            break;
        case 5:
            c.l = c.v = c.n; // h = n to the last bit
            break;
        default:
            break;
        }
        return c;
    }

private:
    static inline const shader::Defines kEverything = frame::featureDefines(frame::allFeatures());
    ShaderBench bench_;
};

} // namespace tessera::test
