// Shaders with one fault each. All techniques share their lighting, so comparing them with each other detects none of
// these; the stability suite, which compares with formulas in double precision, must detect every one.
#include <iterator>
#include <set>

#include "tests/image/ImageTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/stress/Stress.h"
#include "validation/stress/StressRecord.h"
#include "validation/stress/StressScene.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

struct Mutant {
    const char* fault;
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
    const char* seenBy; ///< the case that must fail
};

constexpr Mutant kMutants[] = {
    {"pi off by 1 %", "lib/maths/math.glsl", "kPi = 3.14159265358979323846", "kPi = 3.17300858",
     "brdf/metallic_roughness"},
    {"D below the horizon", "lib/reflectance/brdf.glsl", "if (!(h.along > 0.0)) return 0.0;", "",
     "terms/distribution_0.3"},
    {"D by 1 - (n.h)^2", "lib/reflectance/brdf.glsl", "HalfSum(across, across2, along, length2)",
     "HalfSum(across, length2 - along * along, along, length2)", "terms/distribution_0.002"},
    {"light from below the horizon", "lib/reflectance/reflectance.glsl",
     "max(dot(seen.surface.normalLS, toLight), 0.0)", "dot(seen.surface.normalLS, toLight)", "brdf/lambert"},
    {"a lobe towards viewers below the horizon", "lib/reflectance/reflectance.glsl", "nl > 0.0 && seen.nv > 0.0 &&",
     "nl > 0.0 &&", "brdf/microfacet"},
    {"a lobe beside l = -v", "lib/reflectance/reflectance.glsl", "nl > 0.0 && seen.nv > 0.0 && h.length2 > 0.0",
     "h.along > 0.0", "directions/opposite"},
    {"G1 without the view term", "lib/reflectance/brdf.glsl", "(cosineView + lengthView)", "(2.0 * cosineView)",
     "terms/masking"},
    {"correlated masking with its cosines swapped", "lib/reflectance/brdf.glsl",
     "cosineLight * lengthView + cosineView * lengthLight", "cosineLight * lengthLight + cosineView * lengthView",
     "terms/masking"},
    {"a square root left out", "lib/reflectance/brdf.glsl", "sqrt(alpha2 + (1.0 - alpha2) * (cosine * cosine))",
     "(alpha2 + (1.0 - alpha2) * (cosine * cosine))", "terms/masking"},
    {"F of one polarisation", "lib/reflectance/brdf.glsl", "0.5 * (a * a) * (1.0 + b * b)", "a * a", "terms/fresnel"},
    {"F that cancels near an index of 1", "lib/reflectance/brdf.glsl", "difference = contrast / sum",
     "difference = sqrt(g2) - c", "terms/fresnel"},
    {"no total internal reflection", "lib/reflectance/brdf.glsl", "if (g2 < 0.0) return 1.0;", "",
     "terms/total_reflection"},
    {"Schlick to the fourth", "lib/reflectance/brdf.glsl", "m2 * m2 * m;", "m2 * m2;", "brdf/metallic_roughness"},
    {"what F reflects is also transmitted", "lib/reflectance/reflectance.glsl", "terms.f * (vec3(dv) - seen.diffuse)",
     "terms.f * dv", "brdf/metallic_roughness"},
    {"k_s left out", "lib/reflectance/reflectance.glsl", "surface.specular * (terms.f * dv)", "terms.f * dv",
     "brdf/microfacet"},
    {"alpha squared once more", "lib/material/material.glsl", "surface.alpha = max(roughnessMetallic.x, ALPHA_MIN);",
     "surface.alpha = max(roughnessMetallic.x * roughnessMetallic.x, ALPHA_MIN);", "roughness/microfacet"},
    {"a range window not squared", "lib/light/light.glsl", "(window * window) * min(", "window * min(", "light/range"},
    {"no floor of the distance", "lib/light/light.glsl", "min(inverse2, 1e4)", "inverse2", "light/distance"},
    {"B without the distance", "lib/light/light.glsl", "attenuation.y * distance +", "attenuation.y +",
     "light/distance"},
    {"a cone that points backwards", "lib/light/light.glsl", "toLightLS + shape.axis.xyz", "toLightLS - shape.axis.xyz",
     "light/cone"},
    {"a cone's cosine with 20 bits", "lib/light/light.glsl", ": dot(beside, beside)",
     ": floor(dot(beside, beside) * 524288.0 + 0.5) / 524288.0", "light/cone"},
    {"a cone not squared", "lib/light/light.glsl", "share = cone * cone;", "share = cone;", "light/random"},
    {"a dropped light", "lib/light/light_cursor.glsl", "return LightCursor(0, int(lighting.lights.x));",
     "return LightCursor(1, int(lighting.lights.x));", "lights/scattered"},
    {"normals turned as positions are", "passes/geometry.vert",
     "vec3(dot(drawNormal0.xyz, normalOS), dot(drawNormal1.xyz, normalOS), dot(drawNormal2.xyz, normalOS))",
     "vec3(dot(drawRow0.xyz, normalOS), dot(drawRow1.xyz, normalOS), dot(drawRow2.xyz, normalOS))", "scene/transform"},
    {"positions measured from a far eye", "lib/surface/camera.glsl",
     "precise vec3 position = viewDepth * across + ahead * view.forwardLS.xyz;",
     "precise vec3 position = viewDepth * (across + view.forwardLS.xyz) + view.eyeLS.xyz;", "scene/far_eye"},
    {"back faces keep their normal", "lib/material/material_frame.glsl", "normal = -normal;", "normal = normal;",
     "scene/transform"},
    {"mirrored coordinates without handedness", "lib/material/material_frame.glsl",
     "cross(vertexNormal, tangent) * fragment.tangentLS.w", "cross(vertexNormal, tangent)", "geometry/degenerate"},
    {"zero normals kept", "lib/maths/math.glsl", "if (!(largest > 0.0)) return fallback;", "", "geometry/zero_normal"},
    {"a point in the shadow of its own triangle", "lib/shadow/caster_walk.glsl", "abs(originSide) > originError &&", "",
     "shadow/place"},
    {"casters behind the surface", "lib/shadow/caster_walk.glsl", "(originSide > 0.0) != (lightSide > 0.0);", "true;",
     "shadow/place"},
    {"a triangle without its third edge", "lib/shadow/caster_walk.glsl",
     "min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0", "min(u, v) < 0.0 && max(u, v) > 0.0", "shadow/place"},
    {"boxes a tenth too near", "lib/shadow/caster_walk.glsl", "* 1.000001;", "* 0.9;", "shadow/place"},
    {"a node left out", "lib/shadow/caster_walk.glsl", "walk.node = meets ? walk.node + 1u : low.w;",
     "walk.node = meets ? walk.node + 2u : low.w;", "shadow/place"},
    {"the last triangle of a leaf left out", "lib/shadow/caster_walk.glsl",
     "walk.triangles = casterLeafTriangles(high.w);", "walk.triangles = casterLeafTriangles(high.w) - 1u;",
     "shadow/place"},
    {"a sun that stands before casters", "lib/shadow/traced_shadow.glsl", "farAway = 2.0 * (", "farAway = 0.02 * (",
     "shadow/light"},
    {"light where it is hidden", "lib/shadow/caster_walk.glsl", "walk.isHidden ? 0.0 : 1.0;",
     "walk.isHidden ? 1.0 : 0.0;", "shadow/place"},
    {"shadows where casters would be without their place", "lib/shadow/caster_walk.glsl",
     "casterTree.rwsOriginCS.w + casterTree.rwsOriginCS.xyz;", "casterTree.rwsOriginCS.w;", "shadow/place"},
};

class Mutants : public ImageTest {
protected:
    std::vector<validation::StressResult> run(const std::vector<std::string>& cases,
                                              const shader::SourceTree& shaders) {
        validation::StressRequest request;
        for (const std::string& name : cases)
            for (const validation::StressCase* row : validation::stressCasesNamed(name)) request.cases.push_back(row);
        request.techniques = {Technique::Forward};
        request.effort = validation::StressEffort::Quick;
        request.shaders = shaders;
        return validation::runStress(context(), request);
    }
};

TEST_SWEEP(Mutants, everyFaultIsDetectedByItsCase) {
    ASSERT_GE(std::size(kMutants), 12u);
    std::set<std::string_view> seeing;
    for (const Mutant& mutant : kMutants) {
        if (!seeing.insert(mutant.seenBy).second && !isWholeSweep()) continue;
        SCOPED_TRACE(mutant.fault);
        const ShaderMutant shaders(mutant.file, mutant.from, mutant.to);
        const std::vector<validation::StressResult> results = run({mutant.seenBy}, shaders.tree());
        ASSERT_EQ(results.size(), 1u);
        EXPECT_FALSE(results[0].ok()) << mutant.seenBy << " did not see it: worst relative error "
                                      << results[0].figures.worstRel;
        const std::vector<std::string> missed = results[0].missed();
        fmt::print("{:<45} {}: {}\n", mutant.fault, mutant.seenBy, missed.empty() ? "NOT SEEN" : missed.front());
    }
}

/// Detects a tolerance, weight or scale so wide that nothing can fail: no case passes with half the signal, and none of
/// its images does.
TEST_SWEEP(Mutants, everyCaseFailsWhereItsMeasuredQuantityIsHalved) {
    validation::StressRequest request;
    request.techniques = {Technique::Forward};
    request.effort = validation::StressEffort::Quick;
    request.measuredTimes = 0.5f;
    std::vector<validation::StressCase> rows;
    for (const validation::StressCase& row : everyNth(validation::stressCases(), 2)) {
        if (!row.pictures) {
            rows.push_back(row);
            continue;
        }
        const std::vector<validation::StressPicture> pictures = row.pictures(request.effort);
        const std::size_t count = isWholeSweep() ? pictures.size() : std::min<std::size_t>(pictures.size(), 1);
        for (std::size_t i = 0; i < count; ++i) {
            validation::StressCase one = row;
            one.name += ": " + pictures[i].what;
            // An image that is compared with an earlier one would include that one, which is tested by itself.
            one.pictures = [pictures, i](validation::StressEffort) {
                std::vector<validation::StressPicture> alone{pictures[i]};
                alone.front().sameAs.reset();
                return alone;
            };
            rows.push_back(std::move(one));
        }
    }
    for (const validation::StressCase& row : rows) request.cases.push_back(&row);
    for (const validation::StressResult& result : validation::runStress(context(), request)) {
        EXPECT_FALSE(result.held() <= result.tolerance) << result.name << " holds at half the signal: " << result.held()
                                                        << ", at most " << result.tolerance << " is required";
        EXPECT_GT(result.figures.samples, 0u) << result.name;
    }
}

/// A case that always fails would detect every fault.
TEST_F(Mutants, shadersWithoutAFaultHoldEachOfTheirCases) {
    std::vector<std::string> cases;
    for (const Mutant& mutant : kMutants) cases.emplace_back(mutant.seenBy);
    std::sort(cases.begin(), cases.end());
    cases.erase(std::unique(cases.begin(), cases.end()), cases.end());
    for (const validation::StressResult& result : run(cases, ShaderMutant().tree()))
        EXPECT_TRUE(result.ok()) << result.name << ": " << testing::PrintToString(result.missed());
}

/// Shows that the suite is needed: techniques that share a fault agree.
TEST_F(Mutants, techniquesAgreeOnAFaultTheyShare) {
    const ShaderMutant shaders("lib/maths/math.glsl", "kPi = 3.14159265358979323846", "kPi = 3.17300858");
    const scenes::Scene scene = validation::stressScene();
    engine::Renderer renderer(context(), scene, shaders.tree());
    validation::CompareRequest request;
    request.settings.sizePixels = {64, 45};
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) request.techniques.push_back(info.technique);
    EXPECT_TRUE(validation::compareTechniques(renderer, context().capabilities(), request).record.ok());
}

/// The stability suite: its short form by default, in full where slow tests run.
class Stress : public ImageTest {
protected:
    /// Runs the cases; those that draw images use `techniques` techniques, for each case the next ones in turn.
    validation::StressRecord run(const std::vector<validation::StressCase>& cases, validation::StressEffort effort,
                                 std::size_t techniques) {
        validation::StressRecord record{context().capabilities().renderer, effort, {}};
        const auto all = engine::techniqueTable();
        for (std::size_t first = 0; first < all.size(); first += techniques) {
            validation::StressRequest request;
            request.effort = effort;
            for (std::size_t i = 0; i < techniques; ++i) request.techniques.push_back(all[first + i].technique);
            std::size_t turn = 0;
            for (const validation::StressCase& row : cases)
                if (turn++ % (all.size() / techniques) == first / techniques) request.cases.push_back(&row);
            std::ranges::move(runOne(request), std::back_inserter(record.results));
        }
        EXPECT_GE(record.results.size(), cases.size());
        return record;
    }

    std::vector<validation::StressResult> runOne(validation::StressRequest& request) {
        double last = 0.0;
        request.progress = [&last](double share) {
            EXPECT_GE(share, last);
            EXPECT_LE(share, 1.0);
            last = share;
        };
        std::vector<validation::StressResult> results = validation::runStress(context(), request);
        EXPECT_EQ(last, 1.0);
        for (const validation::StressResult& result : results)
            EXPECT_TRUE(result.ok()) << result.name << ": " << testing::PrintToString(result.missed());
        return results;
    }

    /// With every eighth image of its short form, and those that these are compared with.
    static validation::StressCase withFewerPictures(validation::StressCase row) {
        if (!row.pictures) return row;
        std::vector<validation::StressPicture> all = row.pictures(validation::StressEffort::Quick), some;
        std::vector<bool> isTaken(all.size());
        for (std::size_t i = all.size(); i-- > 0;) {
            isTaken[i] = isTaken[i] || i % 8 == 0;
            if (isTaken[i] && all[i].sameAs) isTaken[*all[i].sameAs] = true;
        }
        std::vector<std::size_t> places(all.size()); // in `some`
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!isTaken[i]) continue;
            if (all[i].sameAs) all[i].sameAs = places[*all[i].sameAs];
            places[i] = some.size();
            some.push_back(std::move(all[i]));
        }
        row.pictures = [some](validation::StressEffort) { return some; };
        return row;
    }

    static std::uint64_t brdfSamples(const validation::StressRecord& record) {
        std::uint64_t samples = 0;
        for (const validation::StressResult& result : record.results)
            if (result.name.starts_with("brdf/")) samples += result.figures.samples;
        return samples;
    }
};

TEST_F(Stress, everyCaseHoldsInItsShortForm) {
    std::vector<validation::StressCase> cases;
    for (const validation::StressCase& row : validation::stressCases()) cases.push_back(withFewerPictures(row));
    run(cases, validation::StressEffort::Quick, 1);
}

class StressSlow : public Stress {};

TEST_F(StressSlow, everyCaseHoldsOverTenMillionSamplesOfMaterials) {
    const validation::StressRecord record =
        run(validation::stressCases(), validation::StressEffort::Full, engine::techniqueTable().size());
    EXPECT_GE(brdfSamples(record), 10'000'000u);
    fmt::print("{}", validation::stressTable(record));
}

} // namespace
} // namespace tessera
