// Copyright 2026 The percuss authors
// SPDX-License-Identifier: Apache-2.0

// A client of percuss-ros2 by Fast DDS, which most installations of ROS 2 use: asks on the topics about a steel
// sphere on the end of a rod, and prints the restitution; waits for the bodies before.
// usage: ros2_fastdds DOMAIN SPEED

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <thread>

#include "percuss_msgsPubSubTypes.h"

using namespace eprosima::fastdds::dds;
using namespace percuss_msgs::msg::dds_;

template <typename Type>
static Topic *make_topic(DomainParticipant *participant, const char *name)
{
    TypeSupport type(new Type());
    type.register_type(participant);
    return participant->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
}

static DataReader *make_reader(Subscriber *subscriber, Topic *topic, bool kept)
{
    DataReaderQos qos = DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = kept ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().depth = 10;
    return subscriber->create_datareader(topic, qos);
}

// Calls `done` every millisecond until it is true; false after that many seconds.
template <typename Done>
static bool wait_until(Done done, int seconds)
{
    for (int i = 0; i < 1000 * seconds; i++) {
        if (done())
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

static Request_ describe(double speed)
{
    Request_ request;
    request.client().fill(7);
    request.sequence_number(42);
    std::vector<BodyMotion_> bodies(2);
    bodies[0].id("steel-sphere");
    bodies[0].position().x(0.515);
    bodies[0].velocity().x(-speed);
    bodies[0].orientation().w(1.0);
    bodies[1].id("al-rod-1");
    bodies[1].orientation().w(1.0);
    Contact_ contact;
    contact.b(1);
    contact.point().x(0.5);
    contact.normal().x(1.0);
    request.question().bodies(bodies);
    request.question().contacts({contact});
    return request;
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    auto *factory = DomainParticipantFactory::get_instance();
    auto *participant = factory->create_participant(std::atoi(argv[1]), PARTICIPANT_QOS_DEFAULT);
    auto *publisher = participant->create_publisher(PUBLISHER_QOS_DEFAULT);
    auto *subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    auto *bodies = make_reader(subscriber,
        make_topic<BodyList_PubSubType>(participant, "rt/percuss/bodies"), true);
    auto *replies = make_reader(subscriber,
        make_topic<Reply_PubSubType>(participant, "rt/percuss/reply"), false);
    DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    auto *requests = publisher->create_datawriter(
        make_topic<Request_PubSubType>(participant, "rt/percuss/request"), qos);

    BodyList_ list;
    Reply_ reply;
    SampleInfo info;
    if (!wait_until([&] { return bodies->take_next_sample(&list, &info) == ReturnCode_t::RETCODE_OK; }, 20))
        return std::puts("no bodies"), EXIT_FAILURE;
    std::printf("%zu bodies\n", list.bodies().size());
    wait_until([&] {
        PublicationMatchedStatus written;
        SubscriptionMatchedStatus read;
        requests->get_publication_matched_status(written);
        replies->get_subscription_matched_status(read);
        return written.current_count == 1 && read.current_count == 1;
    }, 20);
    // once more where the bridge has heard of this writer only after the question: docs/dds.md
    Request_ request = describe(std::atof(argv[2]));
    bool answered = false;
    for (int i = 0; i < 10 && !answered; i++) {
        requests->write(&request);
        answered = wait_until(
            [&] { return replies->take_next_sample(&reply, &info) == ReturnCode_t::RETCODE_OK; }, 2);
    }
    if (!answered)
        return std::puts("no reply"), EXIT_FAILURE;
    const Answer_ &answer = reply.answer();
    bool own = reply.client() == request.client() && reply.sequence_number() == 42;
    if (!own || answer.status() != 0 || answer.contacts().size() != 1)
        return std::printf("%s\n", answer.message().c_str()), EXIT_FAILURE;
    std::printf("0: %.17g\n", answer.contacts()[0].restitution());
    participant->delete_contained_entities();
    factory->delete_participant(participant);
    return EXIT_SUCCESS;
}
