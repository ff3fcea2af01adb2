#ifndef snug_response_measured_faces_h
#define snug_response_measured_faces_h

#include <snug/response/measured_place.h>

namespace snug::response {
/// A face of this rank and the cell to which it belongs.
struct MeasuredFace
{
  unsigned int index;           ///< index in BodyMesh::boundary_faces()
  unsigned int subdomain, cell; ///< see Assembler::cells()
  /// place of each node of the face in the cell
  std::vector<unsigned int> places;
};

/// Return the faces of the boundary @p parameters.face on this rank. Assemblers list only loaded
/// faces. All other faces are accessed through their cell, where hanging nodes find the unknowns of
/// their masters.
template <int dim>
std::vector<MeasuredFace> faces_of(const state::StateSolver<dim> &solver,
                                   const ResponseParameters      &parameters);

/// Return the values at the nodes of a face, taken from the values at the nodes of its cell.
template <int dim>
std::vector<dealii::Tensor<1, dim>> at_face(const MeasuredFace                        &face,
                                            const std::vector<dealii::Tensor<1, dim>> &of_cell)
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const unsigned int place : face.places)
    result.push_back(of_cell[place]);
  return result;
}
} // namespace snug::response

#endif
