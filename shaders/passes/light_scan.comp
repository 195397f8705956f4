// Compute entry of lib/lists/list_scan.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/lists/list_scan.glsl"

void main()
{
    scanTiles(listItem());
}
