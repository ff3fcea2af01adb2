#ifndef snug_shape_face_basis_h
#define snug_shape_face_basis_h

#include <snug/shape/interior.h>
#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// A linear operator from design variables to the displacements of the
/// nodes of a shaped face; the same numbers on all ranks.
template <int dim>
class FaceModes
{
public:
  using FaceField = typename ShapedFace<dim>::Field;

  virtual ~FaceModes() = default;

  virtual unsigned int n_variables() const = 0;

  /// What is said at hanging nodes is not used.
  virtual FaceField apply(const std::vector<double> &alpha) const = 0;

  virtual std::vector<double> transpose(const FaceField &gradient) const = 0;

  /// As in Shape.
  virtual std::vector<Control<dim>> controls() const = 0;
};

/// V = E C M: modes of a face M, its hanging nodes made to follow C, and
/// the body's interior E.
template <int dim>
class FaceBasis : public Shape<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  FaceBasis(std::unique_ptr<ShapedFace<dim>> face,
            std::unique_ptr<FaceModes<dim>>  modes,
            std::unique_ptr<Interior<dim>>   interior);

  unsigned int              n_variables() const override;
  Field                     apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const Field &gradient) const override;
  std::vector<Control<dim>> controls() const override;
  std::vector<std::pair<unsigned int, unsigned int>> faces() const override;

private:
  std::unique_ptr<ShapedFace<dim>> face;
  std::unique_ptr<FaceModes<dim>>  modes;
  std::unique_ptr<Interior<dim>>   interior;
};
} // namespace snug::shape

#endif
