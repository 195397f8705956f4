// Closed-form intersections of rays with area lights. An including file may define cornerOf(light, corner), in the
// units of its positions, together with HAS_CORNERS.
#pragma once

// Relative to the light's centre: points of the ray are start + ahead * direction.
struct Ray {
    vec3 start;
    vec3 direction;
};

// Entry of a ray into a sphere or, given components across an axis, into an infinite cylinder. It is measured from the
// ray's point nearest to the centre, so that no digits cancel for a small light far away.
bool meetsRound(Ray ray, float radius, out float ahead)
{
    precise float square = dot(ray.direction, ray.direction);
    precise float halfway = -dot(ray.start, ray.direction) / square;
    precise vec3 nearest = ray.start + halfway * ray.direction;
    precise float room = radius * radius - dot(nearest, nearest);
    precise float met = halfway - sqrt(max(room, 0.0) / square);
    ahead = met;
    return room > 0.0; // false if the ray runs along the axis
}

// Entry of a ray into a closed cylinder: at the end that faces the ray, else at the lateral surface. `axis`: xyz unit
// axis, w half length.
bool meetsTube(Ray ray, vec4 axis, float radius, out float ahead, out bool isEnd)
{
    precise float direction = dot(ray.direction, axis.xyz), start = dot(ray.start, axis.xyz);
    Ray across;
    precise vec3 directionAcross = ray.direction - direction * axis.xyz;
    precise vec3 startAcross = ray.start - start * axis.xyz;
    across.direction = directionAcross;
    across.start = startAcross;
    isEnd = false;
    if (direction != 0.0) {
        precise float met = (-sign(direction) * axis.w - start) / direction;
        precise vec3 place = startAcross + met * directionAcross;
        ahead = met;
        isEnd = dot(place, place) <= radius * radius;
        if (isEnd) return true;
    }
    // Prevents a gap by rounding between an end and the lateral surface.
    const float kLonger = 1.00001;
    bool meets = meetsRound(across, radius, ahead);
    precise float height = start + ahead * direction;
    return meets && abs(height) <= kLonger * axis.w;
}

#ifdef HAS_CORNERS
// Point-in-polygon test by the even-odd rule.
bool isWithinPolygon(vec2 place, int light, int corners)
{
    bool isWithin = false;
    vec2 from = cornerOf(light, corners - 1);
    for (int i = 0; i < corners; ++i) {
        vec2 to = cornerOf(light, i);
        if ((from.y > place.y) != (to.y > place.y)) {
            // Computed from the lower corner in either direction, so that polygons that share the edge leave no gap.
            vec2 low = from.y < to.y ? from : to, high = from.y < to.y ? to : from;
            precise float side = (high.x - low.x) * (place.y - low.y) - (place.x - low.x) * (high.y - low.y);
            if (side > 0.0) isWithin = !isWithin;
        }
        from = to;
    }
    return isWithin;
}
#endif
