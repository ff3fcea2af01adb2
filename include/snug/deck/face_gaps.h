#ifndef snug_deck_face_gaps_h
#define snug_deck_face_gaps_h

#include <snug/deck/deck_bodies.h>

namespace snug::deck {
/// The distances of the nodes of faces of a body from the nearest faces of another body.
struct FaceGaps
{
  std::set<unsigned int> faces;   ///< faces of the body within reach of the other one
  double                 least;   ///< least and largest distance within reach; negative inside the
  double                 largest; ///< other body [length]
  unsigned int           n_nodes  = 0;    ///< nodes within reach
  bool                   is_whole = true; ///< whether all nodes are within reach
};

/// Faces of a body.
struct BodyFaces
{
  unsigned int           body;
  std::set<unsigned int> faces;
};

/// Return the gaps of faces, whose nodes are within @p reach if their distance is at most that.
/// Quadrilaterals count as two triangles.
FaceGaps
face_gaps(const DeckBodies &bodies, const BodyFaces &of, const BodyFaces &from, double reach);

/// Return the mean length of the edges of faces.
double mean_size(const DeckBodies &bodies, const BodyFaces &of);
} // namespace snug::deck

#endif
