/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* save_scenes FIRST COUNT FOLDER: writes random scenes (bench/any_scene.h) for percussd and its
 * clients, FOLDER/scene-N.yaml and FOLDER/scene-N-BLOW.json. Exit 1: a file cannot be written. */
#include "bench/any_scene.h"

int main(int count, char **words)
{
    if (count != 4)
        return 2;
    static struct any_scene scene;
    struct lab *lab = lab_create();
    unsigned long first = strtoul(words[1], NULL, 10), end = first + strtoul(words[2], NULL, 10);
    bool saved = true;
    for (unsigned long n = first; n < end && saved; n++) {
        char prefix[4000];
        snprintf(prefix, sizeof prefix, "%s/scene-%lu", words[3], n);
        any_scene_draw(lab, n, &scene);
        saved = any_scene_save(lab, &scene, prefix);
        if (!saved)
            perror(prefix);
    }
    lab_free(lab);
    return saved ? 0 : 1;
}
