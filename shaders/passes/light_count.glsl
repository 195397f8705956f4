// Entry point of lib/lists/list_count.glsl.
#include "lib/lists/list_count.glsl"

void main()
{
    countTile(listItem());
}
