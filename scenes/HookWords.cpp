#include "scenes/HookWords.h"

#include <unordered_set>

namespace tessera::scenes {
namespace hookwords {
namespace {

using Words = std::unordered_set<std::string_view>;

const Words& types() {
    static const Words words{"float",   "double",  "int",     "uint",          "bool",      "void",    "vec2",
                             "vec3",    "vec4",    "ivec2",   "ivec3",         "ivec4",     "uvec2",   "uvec3",
                             "uvec4",   "bvec2",   "bvec3",   "bvec4",         "dvec2",     "dvec3",   "dvec4",
                             "mat2",    "mat3",    "mat4",    "mat2x2",        "mat2x3",    "mat2x4",  "mat3x2",
                             "mat3x3",  "mat3x4",  "mat4x2",  "mat4x3",        "mat4x4",    "dmat2",   "dmat3",
                             "dmat4",   "dmat2x2", "dmat2x3", "dmat2x4",       "dmat3x2",   "dmat3x3", "dmat3x4",
                             "dmat4x2", "dmat4x3", "dmat4x4", "HookedSurface", "HookInputs"};
    return words;
}

const Words& qualifiers() {
    static const Words words{"const", "in", "out", "inout", "precise", "highp", "mediump", "lowp"};
    return words;
}

/// Source: Kessenich et al., "The OpenGL Shading Language", version 4.50, sections 3.6 and 8.1 to 8.8.
const Words& others() {
    static const Words words{
        "if", "else", "for", "while", "do", "switch", "case", "default", "break", "continue", "return", "struct",
        "precision", "true", "false",
        // Angles, exponents, numbers
        "radians", "degrees", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh",
        "atanh", "pow", "exp", "log", "exp2", "log2", "sqrt", "inversesqrt", "abs", "sign", "floor", "trunc", "round",
        "roundEven", "ceil", "fract", "mod", "modf", "min", "max", "clamp", "mix", "step", "smoothstep", "isnan",
        "isinf", "floatBitsToInt", "floatBitsToUint", "intBitsToFloat", "uintBitsToFloat", "fma", "frexp", "ldexp",
        "packUnorm2x16", "packSnorm2x16", "packUnorm4x8", "packSnorm4x8", "unpackUnorm2x16", "unpackSnorm2x16",
        "unpackUnorm4x8", "unpackSnorm4x8", "packHalf2x16", "unpackHalf2x16", "packDouble2x32", "unpackDouble2x32",
        // Vectors, matrices, bits
        "length", "distance", "dot", "cross", "normalize", "faceforward", "reflect", "refract", "matrixCompMult",
        "outerProduct", "transpose", "determinant", "inverse", "lessThan", "lessThanEqual", "greaterThan",
        "greaterThanEqual", "equal", "notEqual", "any", "all", "not", "uaddCarry", "usubBorrow", "umulExtended",
        "imulExtended", "bitfieldExtract", "bitfieldInsert", "bitfieldReverse", "bitCount", "findLSB", "findMSB",
        // lib/material/hook_interface.glsl
        "hook", "hookSurface", "hookVertex"};
    return words;
}

} // namespace
} // namespace hookwords

bool isHookType(std::string_view word) {
    return hookwords::types().contains(word);
}
bool isHookQualifier(std::string_view word) {
    return hookwords::qualifiers().contains(word);
}
bool isHookWord(std::string_view word) {
    return isHookType(word) || isHookQualifier(word) || hookwords::others().contains(word);
}

} // namespace tessera::scenes
