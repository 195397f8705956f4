// The fragment side of rasterised geometry: what geometry.vert interpolates, gathered for lib/material.glsl.
#pragma once
#include "lib/material.glsl"

layout(location = 0) in vec3 normalLS;
layout(location = 1) in vec4 tangentLS;
layout(location = 2) in vec2 texCoord0;
layout(location = 3) in vec2 texCoord1;
layout(location = 4) in vec4 vertexColor;
layout(location = 5) flat in vec3 normalFromObject0;
layout(location = 6) flat in vec3 normalFromObject1;
layout(location = 7) flat in vec3 normalFromObject2;

Fragment rasterisedFragment()
{
    Fragment fragment;
    fragment.normalLS = normalLS;
    fragment.tangentLS = vec4(0.0);
    fragment.texCoord[0] = vec2(0.0);
    fragment.texCoord[1] = vec2(0.0);
    fragment.color = vec4(1.0);
    fragment.normalFromObject = mat3(1.0);
#if HAS_TANGENT_SPACE_NORMALS
    fragment.tangentLS = tangentLS;
#endif
#if HAS_TEXTURES
    fragment.texCoord[0] = texCoord0;
#if HAS_TEXCOORD1
    fragment.texCoord[1] = texCoord1;
#endif
#endif
#if HAS_VERTEX_COLOR
    fragment.color = vertexColor;
#endif
#if HAS_OBJECT_SPACE_NORMALS
    // The rows of the matrix, as the vertex stage has them.
    fragment.normalFromObject = transpose(mat3(normalFromObject0, normalFromObject1, normalFromObject2));
#endif
    fragment.frontFacing = gl_FrontFacing;
    return fragment;
}
