// Entry point of lib/lists/list_fill.glsl.
#include "lib/lists/list_fill.glsl"

void main()
{
    fillTile(listItem());
}
