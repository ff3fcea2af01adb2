#ifndef snug_scene_check_h
#define snug_scene_check_h

#include <snug/scene/scene.h>
#include <snug/scene/statements.h>

#include <string>
#include <vector>

namespace snug::scene {
/**
 * Throw an InputError that begins with the entry's origin unless the scene
 * makes sense as a whole:
 *
 * - numbers are finite, lists have as many entries as the scene has
 *   dimensions, moduli, sizes, cells and tolerances lie in their ranges;
 * - every region of a body has one material;
 * - bodies are there and have different names; boundaries that supports,
 *   loads, pairs and shapes name exist; meshes can be made;
 * - the model fits the dimension, and thickness, formulation and bodies fit
 *   the model;
 * - no face is paired with itself or twice; obstacles can be made, and
 *   formulas be read;
 * - tasks that need design variables have some, with bounds that are not
 *   empty and hold the initial design; shape bases read what is set;
 * - responses measure what is there; objective and constraints are
 *   responses, with limits the algorithm can hold.
 */
void check(const Scene &scene, const Origins &origins = Origins());

/// @name Parts of check()
/// @{
void check_names(const Scene &scene, const Origins &origins);
void check_mesh(const Scene &scene, const Body &body, const Origins &origins);
void check_bodies(const Scene &scene, const Origins &origins);
/// Materials of the scene.
void check_materials(const Scene &scene, const Origins &origins);
/// Materials of a body, whose mesh can be made.
void check_regions(const Scene &scene, const Body &body, const Origins &origins);
void check_loads(const Scene &scene, const Origins &origins);
void check_contact(const Scene &scene, const Origins &origins);
void check_shapes(const Scene &scene, const Origins &origins);
void check_methods(const Scene &scene, const Origins &origins);
void check_responses(const Scene &scene, const Origins &origins);
/// @}

/// The error of a body's mesh, which names its entries "entry 'Box cells'",
/// with origin and section.
InputError mesh_error(const Body &body, const Origins &origins, const std::string &message);

/// Throw unless @p face is "body.boundary" of the scene; it is (a part of)
/// the @p value of the entry @p path.
void require_face(const Scene       &scene,
                  const Origins     &origins,
                  const std::string &path,
                  const std::string &value,
                  const std::string &face);

/// Throw unless @p formula, a part of the @p value of the entry @p path, is
/// a formula of the coordinates.
void require_formula(unsigned int       dimension,
                     const Origins     &origins,
                     const std::string &path,
                     const std::string &value,
                     const std::string &formula);

/// "components are x, y and normal".
std::string component_names(unsigned int dimension);

/// "a, b, c".
std::string listed(const std::vector<std::string> &names);
} // namespace snug::scene

#endif
