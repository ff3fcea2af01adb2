#ifndef snug_deck_scene_loads_h
#define snug_deck_scene_loads_h

#include <snug/deck/deck_model.h>
#include <snug/deck/entry.h>

namespace snug::deck {
/// The supports and loads of a deck as entries of a parameter file.
struct SceneLoads
{
  struct LoadCase
  {
    std::string        name;
    bool               is_load_step;
    std::vector<Entry> entries;
  };

  std::vector<std::vector<Entry>>                         of_bodies;    ///< entries of each body
  std::vector<Entry>                                      of_obstacles; ///< displacements
  std::vector<std::pair<std::string, std::vector<Entry>>> points;       ///< reference points
  std::vector<std::vector<Entry>>                         of_bolts;     ///< entries of each bolt
  std::string                                             gravity;      ///< of the scene
  std::vector<LoadCase>                                   cases; ///< of a deck with several steps
};

/**
 * Return the entries. The loads of a deck with one step are those of the bodies. Several steps are
 * load cases with the loads at their ends; with friction or bolts, from the second one on, load
 * steps. Parts of the model without an entry are noted in @p remarks.
 */
SceneLoads scene_loads(const DeckModel &model, const DeckBodies &bodies, Remarks &remarks);

/// Add the motions and loads of reference nodes to @p loads. A force F and a moment M at the node p
/// of a distributing coupling are 'Force' F and 'Moment' M + (p - c) x F of a boundary with
/// centroid c.
void add_reference_points(const DeckModel                            &model,
                          const DeckBodies                           &bodies,
                          const std::vector<const DeckModel::Step *> &steps,
                          Remarks                                    &remarks,
                          SceneLoads                                 &loads);
} // namespace snug::deck

#endif
