/* SPDX-License-Identifier: MIT */
/* The C library in a program in C, of C89 but for <stdint.h>. Usage: consumer_c MESH */
#include <stdio.h>
#include <string.h>

#include "deliso/c/deliso.h"

static float samples[20][20][20];

int main(int argc, char** argv) {
  const size_t shape[3] = {20, 20, 20};
  const char* const options[] = {"max-distance=0.2vox", NULL};
  const char* const wrong[] = {"max-distance=far", NULL};
  deliso_volume* volume = NULL;
  deliso_mesh *mesh = NULL, *none = NULL;
  size_t triangles = 0;
  int x, y, z;
  if (argc != 2) return 2;
  for (z = 0; z < 20; ++z) {
    for (y = 0; y < 20; ++y) {
      for (x = 0; x < 20; ++x) samples[z][y][x] = (float)(x * y + y * z + z * x);
    }
  }
  if (deliso_volume_create(samples, DELISO_FLOAT32, shape, DELISO_C_ORDER, NULL, &volume) !=
          DELISO_OK ||
      deliso_mesh_create(volume, 300.5, options, NULL, &mesh) != DELISO_OK ||
      deliso_mesh_save(mesh, argv[1]) != DELISO_OK) {
    fprintf(stderr, "consumer_c: %s\n", deliso_last_error());
    return 1;
  }
  if (deliso_mesh_create(volume, 300.5, wrong, NULL, &none) != DELISO_BAD_INPUT ||
      strstr(deliso_last_error(), "--max-distance") == NULL) {
    return 1;
  }
  deliso_mesh_triangles(mesh, &triangles);
  printf("deliso %s from C: %lu triangles\n", deliso_version(), (unsigned long)triangles);
  deliso_mesh_free(mesh);
  deliso_volume_free(volume);
  return 0;
}
