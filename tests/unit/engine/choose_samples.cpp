#include "engine/ChooseSamples.h"

#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/Renderer.h"
#include "engine/Settings.h"
#include "scenes/Load.h"
#include "tests/support/ErrorText.h"

namespace tessera::engine {
namespace {

using testing::HasSubstr;

std::string faultOf(const auto& work) {
    return test::errorText<InputError>(work);
}

frame::FrameSettings requesting(int samples) {
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.samples = samples;
    return settings;
}

gpu::Capabilities giving(const std::vector<std::size_t>& samples) {
    gpu::Capabilities capabilities;
    capabilities.samplePlaces.clear();
    for (const std::size_t number : samples) capabilities.samplePlaces.emplace_back(number, glm::vec2(0.5f));
    return capabilities;
}

TEST(ChooseSamples, aTechniqueWithAGBufferIsRefusedWithTheNamesOfThoseThatCan) {
    for (const TechniqueInfo& info : techniqueTable()) {
        EXPECT_NO_THROW(requireSupported({info.technique, requesting(1)}));
        const ViewRequest request{info.technique, requesting(4)};
        EXPECT_EQ(faultOf([&] { requireSupported(request); }).empty(), info.multisamples()) << info.name;
        EXPECT_FALSE(info.multisamples() && info.usesGBuffer()) << info.name;
    }
    EXPECT_THAT(faultOf([] {
                    requireSupported({Technique::Deferred, requesting(2)});
                }),
                HasSubstr("technique deferred does not support samples 2, since it has a G-buffer; forward, "));
}

TEST(ChooseSamples, invalidSampleCountsAreRefused) {
    const scenes::Scene room = scenes::loadScene("room");
    for (const int samples : {-1, 0, 3, 8}) {
        EXPECT_EQ(faultOf([&] { planFrame(room, Technique::Forward, requesting(samples)); }),
                  "samples " + std::to_string(samples) + ": a pixel can have 1, 2, 4 samples");
    }
}

// Code that derives single sampling from the requested sample count relies on this.
TEST(ChooseSamples, aFrameHasASingleSampleExactlyWhereOneIsRequested) {
    const std::vector<std::size_t> drivers[] = {{1}, {1, 2}, {1, 4}, {1, 2, 4, 8}};
    for (const std::vector<std::size_t>& driver : drivers)
        for (const int requested : frame::kSampleCounts) {
            int given = 0;
            const std::string fault =
                faultOf([&] { given = chooseSamples(settingsOn(giving(driver), requesting(requested))); });
            EXPECT_EQ(fault.empty(), std::size_t(requested) <= driver.back()) << fault;
            EXPECT_TRUE(!fault.empty() || (given == 1) == (requested == 1)) << given << " for " << requested;
        }
    const scenes::Scene room = scenes::loadScene("room");
    for (const TechniqueInfo& info : techniqueTable())
        EXPECT_EQ(faultOf([&] { planFrame(room, info.technique, requesting(4)); }).empty(), info.multisamples())
            << info.name << " draws what it cannot take";
}

TEST(ChooseSamples, aDriverGivesItsNextLargerNumberAndThePlanSaysBoth) {
    const gpu::Capabilities fours = giving({1, 4});
    EXPECT_EQ(settingsOn(fours, requesting(1)).samplePlaces.size(), 1u);
    EXPECT_EQ(settingsOn(fours, requesting(2)).samplePlaces.size(), 4u);
    EXPECT_EQ(settingsOn(fours, requesting(4)).samplePlaces.size(), 4u);
    EXPECT_EQ(settingsOn(giving({1, 2, 8}), requesting(4)).samplePlaces.size(), 8u);
    gpu::Capabilities roomy = fours;
    roomy.texturesAStage = 48;
    EXPECT_EQ(settingsOn(roomy, requesting(1)).texturesAStage, 48);
    EXPECT_EQ(faultOf([] {
                  settingsOn(giving({1, 2}), requesting(4));
              }),
              "samples 4: this driver's 32-bit float render targets have 1 or 2 samples; request fewer");

    const scenes::Scene room = scenes::loadScene("room");
    const graph::Plan plan = planFrame(room, Technique::ForwardPrepass, settingsOn(fours, requesting(2)));
    const auto choice = std::ranges::find(plan.choices, "samples", &graph::Plan::Choice::what);
    ASSERT_NE(choice, plan.choices.end());
    EXPECT_EQ(choice->chosen, "4");
    EXPECT_EQ(choice->why, "the setting samples is 2; the driver's next larger number");
    for (const graph::Plan::Resource& resource : plan.resources) {
        const bool drawn = resource.name == "depth" || resource.name == "radiance";
        EXPECT_EQ(resource.samples, drawn ? 4 : 1) << resource.name;
    }
    EXPECT_TRUE(sampleChoices(requesting(1)).empty());
    EXPECT_THAT(sampleChoices(requesting(2)).at(0).why, HasSubstr("a driver may give more"));
}

} // namespace
} // namespace tessera::engine
