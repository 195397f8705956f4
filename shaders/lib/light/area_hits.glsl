// Where rays meet the surfaces of area lights, in closed form. A file that includes this may bring
// cornerOf(light, corner), in the units of its places, and says so by HAS_CORNERS.
#pragma once

// From the middle of the light: a point of the ray is start + ahead * direction.
struct Ray {
    vec3 start;
    vec3 direction;
};

// Where the ray enters a ball, or of components across an axis an endless cylinder. Measured from the point that is
// nearest to the middle, no digits cancel for a small light far away.
// Source: Haines, Guenther, Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection".
bool meetsRound(Ray ray, float radius, out float ahead)
{
    precise float square = dot(ray.direction, ray.direction);
    precise float halfway = -dot(ray.start, ray.direction) / square;
    precise vec3 nearest = ray.start + halfway * ray.direction;
    precise float room = radius * radius - dot(nearest, nearest);
    precise float met = halfway - sqrt(max(room, 0.0) / square);
    ahead = met;
    return room > 0.0; // false where the ray runs along the axis
}

// A closed cylinder around a unit axis, w half its length: the end that faces the ray, or else the mantle between the
// ends.
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
    // Rounding leaves no gap between an end and the mantle.
    const float kLonger = 1.00001;
    bool meets = meetsRound(across, radius, ahead);
    precise float height = start + ahead * direction;
    return meets && abs(height) <= kLonger * axis.w;
}

#ifdef HAS_CORNERS
// Whether edges to one side of a place cross its height an odd number of times.
bool isWithinPolygon(vec2 place, int light, int corners)
{
    bool isWithin = false;
    vec2 from = cornerOf(light, corners - 1);
    for (int i = 0; i < corners; ++i) {
        vec2 to = cornerOf(light, i);
        if ((from.y > place.y) != (to.y > place.y)) {
            // From the lower corner whichever way the edge runs, so that surfaces that share it leave no gap.
            vec2 low = from.y < to.y ? from : to, high = from.y < to.y ? to : from;
            precise float side = (high.x - low.x) * (place.y - low.y) - (place.x - low.x) * (high.y - low.y);
            if (side > 0.0) isWithin = !isWithin;
        }
        from = to;
    }
    return isWithin;
}
#endif
