// Normals and tangents of a material at a fragment.
#pragma once
#include "lib/material/material_values.glsl"
#include "lib/maths/math.glsl"

bool materialFlag(uint flag)
{
    return (material.kind.y & flag) != 0u;
}

// Turns the normal of a double-sided material to the visible side.
vec3 facing(Fragment fragment, vec3 normal)
{
#if HAS_DOUBLE_SIDED
    if (materialFlag(MATERIAL_FLAG_DOUBLE_SIDED) && !fragment.frontFacing) normal = -normal;
#endif
    return normal;
}

// Bends a normal until it faces the viewer (lib/raster/facing.glsl), by raising its component along the viewer's
// direction; this is continuous up to a normal that points straight away. A normal that faces the viewer keeps its bits
// and length.
vec3 bentToViewer(Fragment fragment, vec3 normal)
{
    vec3 unit = safeNormalize(normal, vec3(0.0, 0.0, 1.0));
    precise float along = dot(unit, fragment.toViewerLS);
    if (!(along < fragment.leastFacing)) return normal;
    precise vec3 bent = unit + (fragment.leastFacing - along) * fragment.toViewerLS;
    return safeNormalize(bent, unit);
}

#if HAS_TANGENTS
// Lighting-space direction with these components along tangent, bitangent and normal.
vec3 fromTangentSpace(Fragment fragment, vec3 vertexNormal, vec3 direction)
{
    vec3 tangent = safeNormalize(fragment.tangentLS.xyz, vec3(0.0));
    precise vec3 bitangent = cross(vertexNormal, tangent) * fragment.tangentLS.w;
    precise vec3 turned = direction.x * tangent + direction.y * bitangent + direction.z * vertexNormal;
    return turned;
}

// A texture's vector along tangent and bitangent, rotated by the texture's transform relative to the texture that they
// follow. `turn`: as in MaterialConstants.
vec2 turnedTexel(vec2 texel, vec3 turn)
{
    precise float across = texel.y * turn.z;
    precise vec2 turned = vec2(turn.x * texel.x - turn.y * across, turn.y * texel.x + turn.x * across);
    return turned;
}

vec3 tangentSpaceNormal(Fragment fragment, vec3 vertexNormal, vec3 texel, float scale, vec3 turn)
{
    precise vec3 mapped = texel * 2.0 - 1.0;
    precise vec2 scaled = mapped.xy * scale;
    vec3 direction = vec3(turnedTexel(scaled, turn), mapped.z);
    return safeNormalize(fromTangentSpace(fragment, vertexNormal, direction), vertexNormal);
}
#endif

// Shading normal, not always unit; 0 if it has no direction.
vec3 materialNormal(Fragment fragment, vec3 texel)
{
    vec3 normal = fragment.normalLS;
#if HAS_NORMAL_TEXTURE
    vec3 vertexNormal = safeNormalize(fragment.normalLS, vec3(0.0, 0.0, 1.0));
    if (materialFlag(MATERIAL_FLAG_NORMAL_MAP)) {
        if (materialFlag(MATERIAL_FLAG_OBJECT_SPACE_NORMAL)) {
#if HAS_OBJECT_SPACE_NORMALS
            precise vec3 mapped = texel * 2.0 - 1.0;
            precise vec3 turned = fragment.normalFromObject * mapped;
            normal = safeNormalize(turned, vertexNormal);
#endif
        } else {
#if HAS_TANGENT_SPACE_NORMALS
            normal = tangentSpaceNormal(fragment, vertexNormal, texel, material.microsurface.w, vec3(1.0, 0.0, 1.0));
#endif
        }
    }
#endif
    return facing(fragment, normal);
}

#if VIEW == VIEW_NORMAL_OBJECT
// Shading normal in object space, 0 if the node's transform flattens its direction: normals go to lighting space by the
// cofactor matrix times the sign of the determinant, which the transposed matrix inverts up to a factor > 0.
vec3 objectNormal(Fragment fragment, vec3 normal)
{
    mat3 m = fragment.objectFromNormal;
    vec3 back = m * normal;
    vec3 largest = max(max(abs(m[0]), abs(m[1])), abs(m[2]));
    float rounding = 1e-6 * max(max(largest.x, largest.y), largest.z);
    return dot(back, back) > rounding * rounding ? safeNormalize(back, vec3(0.0)) : vec3(0.0);
}
#endif
