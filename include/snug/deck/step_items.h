#ifndef snug_deck_step_items_h
#define snug_deck_step_items_h

#include <snug/deck/deck_model.h>

#include <algorithm>

namespace snug::deck {
/// Return whether OP = NEW ends what earlier steps have given.
inline bool is_new(const mesh_file::Keyword &keyword)
{
  return mesh_file::upper_case(keyword.option("OP")) == "NEW";
}

/// Return the step in which an item is given.
inline unsigned int step_of(const std::vector<DeckModel::Given> &sum)
{
  return sum.front().step;
}

template <typename Item>
unsigned int step_of(const Item &item)
{
  return item.step;
}

/// Erase the items for which a condition holds.
template <typename Item, typename Condition>
void erase_if(std::vector<Item> &items, const Condition &condition)
{
  items.erase(std::remove_if(items.begin(), items.end(), condition), items.end());
}

/// Erase what the steps before @p step have given.
template <typename Item>
void drop_earlier(std::vector<Item> &items, const unsigned int step)
{
  erase_if(items, [&](const Item &item) { return item.step < step; });
}

template <typename Key, typename Item>
void drop_earlier(std::map<Key, Item> &items, const unsigned int step)
{
  for (auto item = items.begin(); item != items.end();)
    item = step_of(item->second) < step ? items.erase(item) : std::next(item);
}
} // namespace snug::deck

#endif
