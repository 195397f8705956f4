// First step: finds the rows and columns of tiles that each light may touch, by the planes between them, which are
// tested once per light instead of once per tile.
#pragma once
#include "lib/lists/list_items.glsl"
#include "lib/lists/list_lights.glsl"

layout(std430, binding = STORAGE_LIGHT_REACH) writeonly buffer LightReach
{
    uvec2 lightReach[]; // columns, rows: first | last << 16
};

bool touchesColumn(vec4 sphere, uint column)
{
    vec4 slab = slabBetween(raysOfTile(column, 0u).xy, raySpread());
    return sphereTouchesSlab(sphere.x, spreadAt(sphere.z, raySpread()), sphere.w, slab);
}

bool touchesRow(vec4 sphere, uint row)
{
    vec4 slab = slabBetween(raysOfTile(0u, row).zw, raySpread());
    return sphereTouchesSlab(sphere.y, spreadAt(sphere.z, raySpread()), sphere.w, slab);
}

void findReach(uvec2 item)
{
    uint light = item.y * LIST_LIGHTS_A_ROW + item.x;
    if (light >= lightCount()) return;
    vec4 sphere = cullSphere(light);
    uvec2 columns = uvec2(1u, 0u);
    uvec2 rows = uvec2(1u, 0u);
    // Unbounded lights are in no tile's list.
    if (sphere.w >= 0.0) {
        for (uint i = 0u; i < lighting.tileGrid.x; ++i) {
            if (touchesColumn(sphere, i)) columns = uvec2(columns.x > columns.y ? i : columns.x, i);
        }
        for (uint i = 0u; i < lighting.tileGrid.y; ++i) {
            if (touchesRow(sphere, i)) rows = uvec2(rows.x > rows.y ? i : rows.x, i);
        }
    }
    lightReach[light] = uvec2(columns.x | columns.y << 16, rows.x | rows.y << 16);
}
