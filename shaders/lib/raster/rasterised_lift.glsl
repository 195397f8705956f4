// Shadow lift: offset of shadow look-ups above a smooth-shaded triangle, to the surface that the tangent planes of its
// corners span (Hanika 2021, "Hacking the Shadow Terminator", Ray Tracing Gems II, chapter 4). Each plane lies
// dot(normal, corner - point) above the point, and the barycentric weights blend these heights:
//   sum of weight_i dot(normal_i, corner_i - point) = sum over the edges of weight_i weight_j dot(corner_j - corner_i,
//   normal_j - normal_i)
// So triangles with a common edge agree along it, and a triangle with equal vertex normals has exactly no lift. On a
// concave surface the planes lie below the triangle, which may turn away from lights that its normals face: there the
// lift is the absolute height.
#pragma once
#if BY_TRIANGLE
layout(location = 2) flat in float facetIsLifted;

float rasterisedLift(dvec3 weights)
{
    if (!(facetIsLifted > 0.0)) return 0.0;
    dvec3 normal = weights.x * dvec3(triangleNormalLS[0]) + weights.y * dvec3(triangleNormalLS[1])
                   + weights.z * dvec3(triangleNormalLS[2]);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        int j = i == 2 ? 0 : i + 1;
        dvec3 edge = dvec3(triangleLS[j]) - dvec3(triangleLS[i]);
        sum += weights[i] * weights[j] * dot(edge, dvec3(triangleNormalLS[j]) - dvec3(triangleNormalLS[i]));
    }
    return abs(float(sum / sqrt(max(dot(normal, normal), 1e-300LF))));
}
#else
layout(location = 18) in float tangentPlane;
layout(location = 19) flat in float facetIsLifted;

// `normal`: interpolated at the point, not unit; `aside`: offset in pixels from where attributes are interpolated.
float rasterisedLift(vec3 positionLS, vec3 normal, vec2 aside)
{
    precise float plane = tangentPlane;
#if SAMPLES > 1
    precise float planeAside = plane + (aside.x * dFdx(tangentPlane) + aside.y * dFdy(tangentPlane));
    plane = planeAside;
#endif
    precise float metres = (plane - dot(normal, positionLS)) / sqrt(max(dot(normal, normal), 1e-37));
    return facetIsLifted > 0.0 ? abs(metres) : 0.0;
}
#endif
