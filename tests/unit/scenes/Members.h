#pragma once
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include <gtest/gtest.h>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Expects members to have the values of a text such as "metallic 0.5, emissive 1 2 3, doubleSided 1". `fields` names
/// the members; each value is exactly the nearest to its text.
template <typename Owner, typename Fields>
void expectFields(const Owner& owner, const Fields& fields, const std::string& wanted) {
    std::istringstream parts(wanted);
    for (std::string part; std::getline(parts >> std::ws, part, ',');) {
        std::istringstream words(part);
        std::string name, number;
        words >> name;
        bool isFound = false;
        const auto expectNext = [&](auto value) {
            ASSERT_TRUE(words >> number) << part;
            const bool isSingle = std::is_same_v<decltype(value), float>;
            EXPECT_EQ(double(value), isSingle ? double(std::stof(number)) : std::stod(number)) << part;
        };
        visitFields(fields, [&](const auto& field) {
            if (name != field.name) return;
            isFound = true;
            const auto& value = owner.*field.member;
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
                expectNext(value);
            else if constexpr (requires { value.length(), value.x; })
                for (int i = 0; i < value.length(); ++i) expectNext(value[i]);
            else
                ADD_FAILURE() << part << " is no number";
        });
        EXPECT_TRUE(isFound) << "there is no member " << name;
        EXPECT_FALSE(words >> number) << part << " is too long";
    }
}
inline void expectMembers(const Material& material, const std::string& wanted) {
    expectFields(material, kMaterialFields, wanted);
}
inline void expectMembers(const Light& light, const std::string& wanted) {
    expectFields(light, kLightFields, wanted);
}

} // namespace tessera::scenes
