// Outputs the whole triangle to every fragment, for --filter exact (lib/surface/triangle.glsl); copies other outputs.
#include "shared/slots.h"
#include "shared/hook.h"
#include "shared/views.h"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

invariant gl_Position;

layout(location = 10) in vec3 vertexLS[];
layout(location = 10) flat out vec3 triangleLS[3];
#if HAS_TEXCOORDS
layout(location = 2) in vec2 vertexTexCoord0[];
#if HAS_TEXCOORD1
layout(location = 3) in vec2 vertexTexCoord1[];
#endif
layout(location = 13) flat out vec4 triangleTexCoords[3];
#endif

#if !DEPTH_ONLY
layout(location = 0) in vec3 vertexNormalLS[];
layout(location = 16) flat out vec3 triangleNormalLS[3];
#if HAS_TANGENTS
layout(location = 1) in vec4 vertexTangentLS[];
layout(location = 1) out vec4 tangentLS;
#endif
#if HAS_SHADOWS
layout(location = 9) flat in vec3 vertexFacetNormalLS[];
layout(location = 9) flat out vec3 facetNormalLS;
#endif
#if HAS_SHADOW_LIFT
layout(location = 19) flat in float vertexFacetIsLifted[];
layout(location = 2) flat out float facetIsLifted;
#endif
#if HAS_OBJECT_SPACE_NORMALS
layout(location = 5) flat in vec3 vertexNormalFromObject0[];
layout(location = 6) flat in vec3 vertexNormalFromObject1[];
layout(location = 7) flat in vec3 vertexNormalFromObject2[];
layout(location = 5) flat out vec3 normalFromObject0;
layout(location = 6) flat out vec3 normalFromObject1;
layout(location = 7) flat out vec3 normalFromObject2;
#endif
#if VIEW == VIEW_NORMAL_OBJECT
layout(location = 11) flat in vec3 vertexObjectRow0[];
layout(location = 12) flat in vec3 vertexObjectRow1[];
layout(location = 13) flat in vec3 vertexObjectRow2[];
layout(location = 20) flat out vec3 objectRow0;
layout(location = 21) flat out vec3 objectRow1;
layout(location = 22) flat out vec3 objectRow2;
#endif
#endif
#if HAS_VERTEX_COLOR
layout(location = 4) in vec4 cornerColor[];
layout(location = 8) flat in float vertexLargestColor[];
layout(location = 4) out vec4 vertexColor;
layout(location = 8) flat out float largestColor;
#endif
#if HAS_SUBSURFACE_DIFFUSION && !DEPTH_ONLY
layout(location = 14) flat in int vertexDiffusionNumber[];
layout(location = 19) flat out int diffusionNumber;
#endif
#if HOOKED
layout(location = 16) in vec3 vertexHookedOS[];
layout(location = 17) flat in float vertexHookedInstance[];
layout(location = 23) out vec3 hookedOS;
layout(location = 24) flat out float hookedInstance;
#endif
#ifdef DRAW_IDS
layout(location = 9) flat in float vertexDrawnObject[];
layout(location = 9) flat out float drawnObject;
#endif

void main()
{
    for (int corner = 0; corner < 3; ++corner) {
        gl_Position = gl_in[corner].gl_Position;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        for (int i = 0; i < 3; ++i) {
            triangleLS[i] = vertexLS[i];
#if HAS_TEXCOORD1 && HAS_TEXCOORDS
            triangleTexCoords[i] = vec4(vertexTexCoord0[i], vertexTexCoord1[i]);
#elif HAS_TEXCOORDS
            triangleTexCoords[i] = vec4(vertexTexCoord0[i], 0.0, 0.0);
#endif
#if !DEPTH_ONLY
            triangleNormalLS[i] = vertexNormalLS[i];
#endif
        }
#if !DEPTH_ONLY
#if HAS_TANGENTS
        tangentLS = vertexTangentLS[corner];
#endif
#if HAS_SHADOWS
        facetNormalLS = vertexFacetNormalLS[2];
#endif
#if HAS_SHADOW_LIFT
        facetIsLifted = vertexFacetIsLifted[2];
#endif
#if HAS_OBJECT_SPACE_NORMALS
        normalFromObject0 = vertexNormalFromObject0[corner];
        normalFromObject1 = vertexNormalFromObject1[corner];
        normalFromObject2 = vertexNormalFromObject2[corner];
#endif
#if VIEW == VIEW_NORMAL_OBJECT
        objectRow0 = vertexObjectRow0[corner];
        objectRow1 = vertexObjectRow1[corner];
        objectRow2 = vertexObjectRow2[corner];
#endif
#endif
#if HAS_VERTEX_COLOR
        vertexColor = cornerColor[corner];
        largestColor = vertexLargestColor[corner];
#endif
#if HAS_SUBSURFACE_DIFFUSION && !DEPTH_ONLY
        diffusionNumber = vertexDiffusionNumber[corner];
#endif
#if HOOKED
        hookedOS = vertexHookedOS[corner];
        hookedInstance = vertexHookedInstance[corner];
#endif
#ifdef DRAW_IDS
        drawnObject = vertexDrawnObject[corner];
#endif
        EmitVertex();
    }
    EndPrimitive();
}
