#include "viewer/edit/NumberText.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

TEST(NumberText, zerosOfSoManyDecimalsHaveNoMinus) {
    EXPECT_EQ(numberText("%.3f", -0.0), "0.000");
    EXPECT_EQ(numberText("%.3f", -0.0004), "0.000");
    EXPECT_EQ(numberText("%.3f", -0.0006), "-0.001");
    EXPECT_EQ(numberText("%.3f m", -4.25), "-4.250 m");
    EXPECT_EQ(numberText("%.4g", -0.0), "0");
    EXPECT_EQ(numberText("%.4g", -1e-17), "-1e-17") << "which no rounding makes zero";
    EXPECT_EQ(numberText("%.3f", 0.0004), "0.000");
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(numberText("%.3f", -kInfinity), "-inf") << "has no digit but is no zero";
    EXPECT_EQ(numberText("%.0f", -std::numeric_limits<double>::max()).size(), 310u) << "a minus and 309 digits";
}

TEST(NumberText, whatIsNotEditedOfAVectorStaysToTheLastBit) {
    glm::dvec3 value(-1e-4, 0.25, -1e-4);
    const bool isEdited = editShown(value, -10.0, 10.0, "%.3f", [](glm::dvec3& edited) {
        EXPECT_EQ(edited.x, 1e-4) << "so it is shown";
        edited.y = 0.5;
        edited.z = 2.0;
        return true;
    });
    EXPECT_TRUE(isEdited);
    EXPECT_EQ(value, glm::dvec3(-1e-4, 0.5, 2.0));
    EXPECT_FALSE(editShown(value, -10.0, 10.0, "%.3f", [](glm::dvec3&) { return false; }));
    EXPECT_EQ(value.x, -1e-4);
}

TEST(NumberText, aNumberThatIsShownAsZeroCanBeMadeZero) {
    float value = -1e-4f;
    const auto type = [](float& edited) { return std::exchange(edited, 0.0f) != 0.0f; }; // like Dear ImGui's fields
    EXPECT_TRUE(editShown(value, -10.0f, 10.0f, "%.3f", type));
    EXPECT_EQ(value, 0.0f);
    value = -0.0f;
    EXPECT_FALSE(editShown(value, -10.0f, 10.0f, "%.3f", type));
    EXPECT_TRUE(std::signbit(value));
}

} // namespace
} // namespace tessera::viewer
