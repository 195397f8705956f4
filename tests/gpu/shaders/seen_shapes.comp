// The fraction of a clamped cosine, transformed by a matrix, that area lights cover; the normal is z. In: (centre from
// the point, type), LightShapeTexels' two, LightCornerTexels' seven, the three columns of the matrix.
// Out: (fraction, edges of the outline, 0, 0), (factor of the light's image, 0).
#include "shared/light.h"

#define HAS_OTHER_LIGHT_STORE
#define FIRST_COLUMN (1 + LIGHT_SHAPE_TEXELS + LIGHT_CORNER_TEXELS)
#define INPUTS_A_LIGHT (FIRST_COLUMN + 3)

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

vec4 lightTexel(int index, int texel)
{
    return texel == 0 ? inputs[index * INPUTS_A_LIGHT] : vec4(0.0);
}

vec4 lightShapeTexel(int index, int texel)
{
    return inputs[index * INPUTS_A_LIGHT + 1 + texel];
}

#include "lib/reflectance/reflectance.glsl"
#include "lib/light/light.glsl"
#include "lib/light/area_light.glsl"

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    int first = i * INPUTS_A_LIGHT;
    if (first >= inputs.length()) return;
    vec4 place = inputs[first];
    Outline outline = areaOutline(i, int(place.w), place.xyz);
    int column = first + FIRST_COLUMN;
    mat3 cosineFromSurface = mat3(inputs[column].xyz, inputs[column + 1].xyz, inputs[column + 2].xyz);
    precise float perAbove = 1.0 / shareAbove(cosineFromSurface);
    AreaLobe lobe = AreaLobe(mat3(1.0), cosineFromSurface, perAbove);
    int picture = lightPictureOf(lightShapeTexel(i, 1).w);
    float share = outline.edges > 0 ? shareSeen(outline, lobe) : 0.0;
    vec3 factor = outline.edges > 0 && picture >= 0 ? pictureSeen(picture, outline, lobe) : vec3(1.0);
    outputs[2 * i] = vec4(share, float(outline.edges), 0.0, 0.0);
    outputs[2 * i + 1] = vec4(factor, 0.0);
}
