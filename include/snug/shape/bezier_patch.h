#ifndef snug_shape_bezier_patch_h
#define snug_shape_bezier_patch_h

#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace shape
  {
    /**
     * Bézier heights over a face of a body, carried into the body by linear
     * blending to the opposite face:
     *   x(alpha) = reference + b sum_i B_i(s, t) alpha_i d,
     *   B_i(s, t) = B_j^{n1}(s) B_k^{n2}(t),  i = j + n1 k (2D: B_j^{n1}(s)),
     *   B_j^n(s) = binomial(n-1, j) s^j (1-s)^(n-1-j),
     * s, t: box fractions along the face's axes in the order x, y, z; b: box
     * fraction of the distance from the opposite face; d: unit direction.
     * The displacement of a hanging node is interpolated from its masters.
     */
    template <int dim>
    class BezierPatch : public ShapeBasis<dim>
    {
    public:
      using Field = typename ShapeBasis<dim>::Field;

      /// @throws InputError naming the entry Face, Control points, Direction.
      ///   @p mesh must outlive this object.
      BezierPatch(const mesh::BodyMesh<dim> &mesh,
                  const BodyNames           &bodies,
                  const ShapeParameters     &parameters);

      unsigned int
      n_variables() const override;
      Field
      apply(const std::vector<double> &alpha) const override;
      std::vector<double>
      transpose(const Field &gradient) const override;
      std::vector<Control<dim>>
      controls() const override;
      std::vector<std::pair<unsigned int, unsigned int>>
      faces() const override;

    private:
      /// The weights b B_i of one node of the body.
      struct NodeWeights
      {
        unsigned int                                 node; ///< local
        std::vector<std::pair<unsigned int, double>> weights;
      };

      const mesh::BodyMesh<dim> &mesh;
      unsigned int               body, boundary;
      std::vector<unsigned int>  n; ///< heights per tangent axis
      dealii::Tensor<1, dim>     direction;
      std::vector<NodeWeights>   node_weights;

      void
      read_face(const BodyNames &bodies, const std::string &face);
      void
      read_control_points(const std::vector<unsigned int> &numbers);
      void
      read_direction(const std::vector<double> &components);
      std::vector<double>
      weights_at(const dealii::Point<dim> &fraction) const;
      void
      collect_weights();
    };
  } // namespace shape
} // namespace snug

#endif
