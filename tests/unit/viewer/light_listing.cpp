// The list of lights: searching, sorting and grouping.
#include <utility>

#include <gtest/gtest.h>

#include "viewer/edit/LightListing.h"

namespace tessera::viewer {
namespace {

/// Lights whose order differs from every sort order of the listing.
Lights hallLights() {
    Lights lights;
    const auto add = [&](const char* name, scenes::LightType type, float intensity) {
        scenes::Light& light = lights.emplace_back();
        light.name = name;
        light.type = type;
        light.intensity = intensity;
    };
    add("cornice 10", scenes::LightType::Point, 1.0f);
    add("sun", scenes::LightType::Directional, 9.0f);
    add("cornice 2", scenes::LightType::Point, 2.0f);
    add("wisp 1", scenes::LightType::Sphere, 3.0f);
    add("cornice", scenes::LightType::Spot, 4.0f);
    add("wisp 2", scenes::LightType::Point, 5.0f);
    add("Cornice 1", scenes::LightType::Point, 6.0f);
    add("", scenes::LightType::Point, 7.0f);
    return lights;
}

/// The listing as text: headings with the number of their lights.
std::vector<std::string> textOf(const Lights& lights, const LightListing& listing) {
    std::vector<std::string> text;
    for (const ListedLight& row : listedLights(lights, listing))
        text.push_back(row.light == scenes::kNone ? row.group + ": " + std::to_string(row.lights.size())
                                                  : lightLabel(lights, std::size_t(row.light)));
    return text;
}
using Rows = std::vector<std::string>;

TEST(LightListing, namesThatDifferByANumberMakeAGroupThatUnfoldsAtItsFirst) {
    const Lights lights = hallLights();
    LightListing listing;
    EXPECT_EQ(textOf(lights, listing), (Rows{"cornice: 3", "sun", "wisp 1", "wisp 2", "Cornice 1", "light 7"}));
    listing.unfolded = {"cornice"};
    EXPECT_EQ(textOf(lights, listing), (Rows{"cornice: 3", "cornice 10", "cornice 2", "cornice", "sun", "wisp 1",
                                             "wisp 2", "Cornice 1", "light 7"}));
}

TEST(LightListing, isSortedByNameAsPeopleCountByKindAndByIntensity) {
    const Lights lights = hallLights();
    LightListing listing{{}, LightOrder::Name, {"cornice"}};
    EXPECT_EQ(textOf(lights, listing), (Rows{"cornice: 3", "cornice", "cornice 2", "cornice 10", "Cornice 1", "light 7",
                                             "sun", "wisp 1", "wisp 2"}));
    listing.order = LightOrder::Kind;
    EXPECT_EQ(textOf(lights, listing), (Rows{"sun", "point: 5", "cornice", "wisp 1"}));
    listing.order = LightOrder::Intensity;
    EXPECT_EQ(textOf(lights, listing),
              (Rows{"sun", "light 7", "Cornice 1", "wisp 2", "cornice", "wisp 1", "cornice 2", "cornice 10"}));
}

TEST(LightListing, aSearchFindsNamesAndKindsAndUnfoldsWhatItFinds) {
    const Lights lights = hallLights();
    EXPECT_EQ(textOf(lights, {"CORN", LightOrder::Scene, {}}),
              (Rows{"cornice: 3", "cornice 10", "cornice 2", "cornice", "Cornice 1"}));
    EXPECT_EQ(textOf(lights, {"direct", LightOrder::Scene, {}}), Rows{"sun"});
    EXPECT_TRUE(textOf(lights, {"lamp", LightOrder::Scene, {}}).empty());
}

TEST(LightListing, fewLightsHaveNoGroupsAndFoldedOnesAreStillInTheList) {
    Lights lights = hallLights();
    EXPECT_EQ(lightsIn(listedLights(lights, {})), (std::vector<int>{0, 2, 4, 1, 3, 5, 6, 7}));
    EXPECT_EQ(lightsIn(listedLights(lights, {{}, LightOrder::Scene, {"cornice"}})),
              (std::vector<int>{0, 2, 4, 1, 3, 5, 6, 7}));
    lights.pop_back();
    EXPECT_EQ(textOf(lights, {}).size(), lights.size());
}

} // namespace
} // namespace tessera::viewer
