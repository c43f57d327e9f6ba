/* A game's unit test in the game's own project: links cairn::mock, no physics runs. */
#include <cairn/cairn.h>

#include "mock_cairn_body.h"
#include "unity.h"

void test_a_mocked_marble_is_where_the_test_puts_it(void)
{
    static cairn_world world;
    static const cairn_body_id marble = {1, 1};
    cairn_body_position_ExpectAndReturn(&world, marble, cairn_vec2_of(CAIRN_F(3), CAIRN_F(4)));
    const cairn_vec2 at = cairn_body_position(&world, marble);
    TEST_ASSERT_TRUE(cairn_real_length(at.x, at.y) == CAIRN_F(5));
}
