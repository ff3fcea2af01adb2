#ifndef snug_contact_contact_h
#define snug_contact_contact_h

#include <snug/base/choice.h>
#include <snug/contact/face_shape.h>
#include <snug/contact/pair.h>
#include <snug/contact/projection.h>
#include <snug/contact/row_group.h>

#include <memory>

namespace snug
{
  namespace contact
  {
    /// What the rows of a pair are made from. The references to surface and
    /// positions hold until the rows are made, the surface beyond.
    template <int dim>
    struct PairGeometry
    {
      const mesh::Surface<dim>                 &surface;
      FaceShape<dim>                            shape;
      PairFaces                                 sides;
      const typename mesh::Surface<dim>::Field &positions;
    };

    /// The methods a pair of faces can meet by.
    template <int dim>
    const ChoiceTable<std::unique_ptr<RowGroup<dim>>(const PairGeometry<dim> &)>
      &
      contact_method_table();

    /// Where a row stands.
    struct RowPlace
    {
      unsigned int pair;
      unsigned int slave; ///< surface node
    };

    /**
     * All contact rows of a scene: one group per pair, in the order of the
     * pairs. Pairing is done by the constructor and frozen; see RowGroup for
     * the meaning of the functions.
     */
    template <int dim>
    class Contact
    {
    public:
      using Field = typename mesh::Surface<dim>::Field;

      /// Pair at @p positions. @p surface must outlive this object.
      /// @throws InputError naming a pair that is left without rows.
      Contact(const mesh::Surface<dim> &surface,
              const std::vector<Pair>  &pairs,
              unsigned int              degree,
              const Field              &positions);

      unsigned int
      n_rows() const;
      const std::vector<RowPlace> &
      places() const;

      std::vector<Row<dim>>
      rows(const Field &positions) const;
      std::vector<Row<dim>>
      row_derivatives(const Field &positions, const Field &velocity) const;
      /// Contact part of the energy gradient for forces of all rows.
      Field
      energy_gradient(const Field               &positions,
                      const Field               &displacement,
                      const std::vector<double> &forces) const;
      std::vector<double>
      areas(const Field &positions) const;

    private:
      const mesh::Surface<dim>                   &surface;
      std::vector<std::unique_ptr<RowGroup<dim>>> groups; ///< one per pair
      std::vector<RowPlace>                       row_places;
    };
  } // namespace contact
} // namespace snug

#endif
