// Compute entry of lib/lists/list_count.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/lists/list_count.glsl"

void main()
{
    countTile(listItem());
}
