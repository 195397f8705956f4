#pragma once
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>

/// Tables of struct members, used by all code that handles every member.
namespace tessera::scenes {

inline constexpr double kAnyNumber = std::numeric_limits<float>::max(); ///< as a bound: any finite number

/// A member: its name, and for numbers the name in messages and the bounds (checkScene).
template <typename Owner, typename Member>
struct Field {
    const char* name;
    Member Owner::*member;
    const char* what = nullptr; ///< name in messages; null: no bounds here
    double least = 0.0;         ///< of each component
    double most = 0.0;
    const char* unit = ""; ///< of the bounds, appended in messages
};
template <typename Owner, typename Member>
Field(const char*, Member Owner::*) -> Field<Owner, Member>;
template <typename Owner, typename Member>
Field(const char*, Member Owner::*, const char*, double, double) -> Field<Owner, Member>;
template <typename Owner, typename Member>
Field(const char*, Member Owner::*, const char*, double, double, const char*) -> Field<Owner, Member>;

/// Calls `visit` with every row of a tuple of fields.
template <typename Fields, typename Visitor>
constexpr void visitFields(const Fields& fields, Visitor&& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, fields);
}

/// The row of a member.
template <typename Fields, typename Owner, typename Member>
constexpr Field<Owner, Member> fieldOf(const Fields& fields, Member Owner::*member) {
    Field<Owner, Member> found{"", member};
    visitFields(fields, [&](const auto& field) {
        if constexpr (std::is_same_v<decltype(field.member), Member Owner::*>) {
            if (field.member == member) found = field;
        }
    });
    return found;
}

namespace detail {
struct AnyValue {
    template <typename Type>
    operator Type() const;
};
/// Number of members of an aggregate: the most values it can be initialised with.
template <typename Struct, typename... Values>
consteval std::size_t memberCount() {
    if constexpr (requires { Struct{Values{}..., AnyValue{}}; })
        return memberCount<Struct, Values..., AnyValue>();
    else
        return sizeof...(Values);
}
} // namespace detail

} // namespace tessera::scenes
