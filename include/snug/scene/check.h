#ifndef snug_scene_check_h
#define snug_scene_check_h

#include <snug/base/section_check.h>
#include <snug/scene/scene.h>

namespace snug::scene {
/**
 * Check a scene as a whole. Throw an InputError that begins with the origin of the entry unless
 * all of the following conditions hold:
 *
 * - every value has the form and range that is declared with its entry, and
 *   the parameters of each module agree with each other;
 * - every region of a body has one material;
 * - there are bodies, and they have different names; boundaries that supports,
 *   loads, pairs and shapes name exist; meshes can be made;
 * - the model fits the dimension, and thickness, formulation and bodies fit
 *   the model;
 * - no face is paired with itself or twice;
 * - tasks that need design variables have some;
 * - responses measure existing bodies, faces and pairs; objective and
 *   constraints are responses, with limits that the algorithm supports.
 *
 * @p n_ranks is the number of ranks on which the scene will be solved, which limits the number of
 * cells.
 */
void check(const Scene &scene, const Origins &origins = Origins(), unsigned int n_ranks = 1);

/// @name Parts of check()
/// @{
void check_names(const Scene &scene, const Origins &origins);
/// Check mesh, materials and supports.
void check_body(const Scene        &scene,
                const SectionCheck &section,
                const Body         &body,
                unsigned int        n_ranks);
/// Check the loads of a body. Components held by supports and loads are added to @p held.
void check_loads(const SectionCheck &section, const Body &body, LoadParameters::Held &held);
void check_contact(const Scene &scene, const Origins &origins);
void check_shapes(const Scene &scene, const Origins &origins);
void check_responses(const Scene &scene, const Origins &origins);
/// @}

/// Throw unless the body has the boundary @p boundary, which is a part of the @p value of an entry.
void require_boundary(const SectionCheck &section,
                      const std::string  &entry,
                      const std::string  &value,
                      const Body         &body,
                      const std::string  &boundary);

/// Throw unless @p face is "body.boundary" of the scene.
void require_face(const Scene        &scene,
                  const SectionCheck &section,
                  const std::string  &entry,
                  const std::string  &value,
                  const std::string  &face);
} // namespace snug::scene

#endif
